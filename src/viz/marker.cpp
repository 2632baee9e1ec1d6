#include "viz/marker.h"

#include "monarch_flight/viz/frames.h"

namespace monarch_flight {

std_msgs::ColorRGBA colour(float r, float g, float b, float a) {
  std_msgs::ColorRGBA out;
  out.r = r;
  out.g = g;
  out.b = b;
  out.a = a;
  return out;
}

visualization_msgs::Marker triangleList(const std::string& frame, const std::string& group, int id,
                                        const ros::Time& stamp) {
  visualization_msgs::Marker out;
  out.header.frame_id = frame;
  out.header.stamp = stamp;
  out.ns = group;
  out.id = id;
  out.type = visualization_msgs::Marker::TRIANGLE_LIST;
  out.action = visualization_msgs::Marker::ADD;
  out.pose.orientation.w = 1.0;
  out.scale.x = out.scale.y = out.scale.z = 1.0;
  out.color.r = out.color.g = out.color.b = out.color.a = 1.0f;
  return out;
}

void addTriangle(visualization_msgs::Marker& list, const Corner& a, const Corner& b,
                 const Corner& c) {
  for (const Corner* corner : {&a, &b, &c}) {
    list.points.push_back(toPoint(corner->at.cast<double>()));
    list.colors.push_back(corner->colour);
  }
}

}  // namespace monarch_flight
