#include "monarch_flight/viz/model_markers.h"

#include "monarch_flight/viz/frames.h"
#include "monarch_flight/viz/mesh.h"
#include "monarch_flight/viz/urdf.h"
#include "viz/marker.h"
#include "viz/wing_pattern.h"

namespace monarch_flight {
namespace {

/// At the newest pose of its frame, whatever the time.
visualization_msgs::Marker part(const char* frame, int id, const std_msgs::ColorRGBA& colour) {
  visualization_msgs::Marker out = triangleList(frame, "insect", id, ros::Time());
  out.color = colour;
  out.frame_locked = true;
  return out;
}

visualization_msgs::Marker solid(const Mesh& mesh, const char* frame, int id) {
  visualization_msgs::Marker out = part(frame, id, bodyColour());
  out.points.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const Eigen::Vector3f& corner : triangle)
      out.points.push_back(toPoint(corner.cast<double>()));
  }
  return out;
}

WingLook lookOf(const Insect& insect) {
  return insect.name.rfind("monarch", 0) == 0 ? WingLook::kMonarch : WingLook::kClear;
}

visualization_msgs::Marker wing(const Insect& insect, Side side, int id) {
  const bool left = side == Side::kLeft;
  visualization_msgs::Marker out =
      part(left ? frames::kLeftWing : frames::kRightWing, id, wingColour());
  addWing(insect.wings[side].planform, left, lookOf(insect), out);
  return out;
}

}  // namespace

visualization_msgs::MarkerArray modelMarkers(const Insect& insect) {
  visualization_msgs::MarkerArray out;
  out.markers.push_back(wing(insect, Side::kRight, 0));
  if (insect.bare_wing) return out;
  out.markers.push_back(wing(insect, Side::kLeft, 1));
  out.markers.push_back(solid(thoraxMesh(insect), frames::kBodyFrd, 2));
  out.markers.push_back(solid(abdomenMesh(insect), frames::kAbdomen, 3));
  return out;
}

}  // namespace monarch_flight
