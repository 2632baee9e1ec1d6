#include "monarch_flight/viz/flow_scene.h"

#include "monarch_flight/run/wing_speeds.h"
#include "monarch_flight/viz/pressure_cloud.h"

namespace monarch_flight {
namespace {

constexpr std::size_t kMostTriangles = 40000;  // of the vortices of a wing

double qUnit(const Case& c) {
  const double rate = pressureReference(c).speed / c.insect.meanChord();
  return rate * rate;
}

}  // namespace

FlowScene::FlowScene(const Case& c)
    : case_(c), q_unit_(qUnit(c)), wings_{{c, Side::kRight}, {c, Side::kLeft}} {}

bool FlowScene::take(Side side, const sensor_msgs::PointCloud2& cloud) {
  const std::optional<SurfacePressure> surface = surfacePressure(cloud, side);
  if (!surface || surface->facets.empty()) return false;
  wings_[side].take(*surface);
  pressure_stamp_[side] = cloud.header.stamp;
  cp_limit_.add(wings_[side].largest());
  return true;
}

void FlowScene::take(Side side, const FlowPicture& picture, const ros::Time& stamp) {
  flow_[side] = picture;
  flow_stamp_[side] = stamp;
  omega_limit_.add(largestVorticity(picture, q_level_ * q_unit_));
}

void FlowScene::take(const BodyState& body, const JointAngles& angles) {
  body_ = body;
  angles_ = angles;
}

void FlowScene::setQLevel(double level) { q_level_ = level; }

std::vector<FlowScene::Seen> FlowScene::seen() const {
  std::vector<Seen> out;
  for (Side side : Sides{case_.insect.bare_wing ? 1U : 2U})
    out.push_back({side, case_.mirrored ? Side::kRight : side});
  return out;
}

/// From above and a little from the front right, in the axes of the wing.
Eigen::Vector3d FlowScene::light(Side side) const {
  if (!body_) return {0, 0, -1};
  const Eigen::Vector3d world = Eigen::Vector3d(0.25, 0.35, -0.9).normalized();  // NED
  const Eigen::Matrix3d R_BW = wingAttitude(side, case_.insect.beta, angles_.wings[side]);
  return R_BW.transpose() * body_->R_IB().transpose() * world;
}

visualization_msgs::MarkerArray FlowScene::pressure() const {
  visualization_msgs::MarkerArray out;
  for (const auto& [side, source] : seen()) {
    const auto& stamp = pressure_stamp_[source];
    if (stamp) out.markers.push_back(wings_[source].marker(side, cp_limit_.value(), *stamp));
  }
  return out;
}

visualization_msgs::MarkerArray FlowScene::vortices() const {
  visualization_msgs::MarkerArray out;
  PerWing<IsoSurface> surfaces;
  for (Side side : case_.sides())
    if (flow_stamp_[side])
      surfaces[side] = isoSurface(flow_[side], q_level_ * q_unit_, kMostTriangles);
  for (const auto& [side, source] : seen()) {
    if (!flow_stamp_[source]) continue;
    VortexLook look;
    look.limit = omega_limit_.value();
    look.light = light(side);
    out.markers.push_back(
        vortexMarker(surfaces[source], side, side != source, look, *flow_stamp_[source]));
  }
  return out;
}

visualization_msgs::MarkerArray FlowScene::slice(double share) const {
  visualization_msgs::MarkerArray out;
  for (const auto& [side, source] : seen()) {
    if (!flow_stamp_[source]) continue;
    const Planform& wing = case_.insect.wings[source].planform;
    const double y = wing.yRoot() + share * wing.span();
    out.markers.push_back(sliceMarker(flow_[source], side, side != source,
                                      source == Side::kLeft ? -y : y, omega_limit_.value(),
                                      *flow_stamp_[source]));
  }
  return out;
}

ColourScales FlowScene::scales() const {
  ColourScales out;
  if (hasPressure())
    out.scales.push_back(
        colourScale("pressure coefficient", "", cp_limit_.value(), pressureColour));
  if (hasFlow())
    out.scales.push_back(
        colourScale("vorticity along the span", "1/s", omega_limit_.value(), vorticityColour));
  return out;
}

}  // namespace monarch_flight
