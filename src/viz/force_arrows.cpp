#include "monarch_flight/viz/force_arrows.h"

#include <algorithm>
#include <cmath>

#include "monarch_flight/viz/frames.h"

namespace monarch_flight {
namespace {

struct Arrow {
  const char* frame;
  Eigen::Vector3d foot, along;  // [m]
};

visualization_msgs::Marker marker(const Arrow& arrow, int id, double width,
                                  const ros::Time& stamp) {
  visualization_msgs::Marker out;
  out.header.frame_id = arrow.frame;
  out.header.stamp = stamp;
  out.ns = "forces";
  out.id = id;
  out.type = visualization_msgs::Marker::ARROW;
  out.action = visualization_msgs::Marker::ADD;
  out.pose.orientation.w = 1.0;
  out.frame_locked = true;
  out.points = {toPoint(arrow.foot), toPoint(arrow.foot + arrow.along)};
  out.scale.x = width;        // of the shaft
  out.scale.y = 2.2 * width;  // of the head
  out.scale.z = std::min(4.0 * width, 0.4 * arrow.along.norm());
  out.color.r = id == 2 ? 0.95f : 0.98f;
  out.color.g = id == 2 ? 0.30f : 0.80f;
  out.color.b = id == 2 ? 0.55f : 0.15f;
  out.color.a = 1.0f;
  return out;
}

double metresPerNewton(const Case& c) {
  const double weight = c.insect.totalMass() * c.gravity;
  return c.insect.wings.right.planform.span() / (weight > 0.0 ? 2.0 * weight : 0.01);
}

}  // namespace

Eigen::Vector3d centreOfPressure(const Planform& wing, const Loads& loads) {
  const Eigen::Vector3d F = loads.force(), M = loads.moment();
  if (F.z() == 0.0) return Eigen::Vector3d::Zero();
  return {std::clamp(-M.y() / F.z(), wing.xMin(), wing.xMax()),
          std::clamp(M.x() / F.z(), wing.yRoot(), wing.yTip()), 0.0};
}

visualization_msgs::MarkerArray forceArrows(const Case& c, const PerWing<Loads>& loads,
                                            const Eigen::Vector3d& force,
                                            const Eigen::Vector3d& body, const ros::Time& stamp) {
  const double scale = metresPerNewton(c), width = 0.03 * c.insect.meanChord();
  visualization_msgs::MarkerArray out;
  for (Side side : Sides{c.insect.bare_wing ? 1U : 2U}) {
    const bool left = side == Side::kLeft;
    const Eigen::Vector3d foot = centreOfPressure(c.insect.wings[side].planform, loads[side]);
    const Eigen::Vector3d along = scale * loads[side].force();
    const Arrow arrow{left ? frames::kLeftWing : frames::kRightWing, left ? polarImage(foot) : foot,
                      left ? polarImage(along) : along};
    out.markers.push_back(marker(arrow, left ? 1 : 0, width, stamp));
  }
  if (!c.insect.bare_wing)
    out.markers.push_back(marker({frames::kWorldNed, body, scale * force}, 2, 1.5 * width, stamp));
  return out;
}

}  // namespace monarch_flight
