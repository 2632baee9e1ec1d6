#include "monarch_flight/viz/pressure_picture.h"

#include "monarch_flight/viz/pressure_cloud.h"
#include "monarch_flight/viz/pressure_markers.h"

namespace monarch_flight {
namespace {

constexpr double kLift = 0.01;  // of the coloured sides off the wing [mean chords]

}  // namespace

PressurePicture::PressurePicture(const Case& c)
    : reference_(pressureReference(c)),
      bare_wing_(c.insect.bare_wing),
      mirrored_(c.mirrored),
      span_(c.insect.wings.right.planform.span()),
      lift_(kLift * c.insect.meanChord()) {}

visualization_msgs::MarkerArray PressurePicture::legend() const {
  return pressureLegend(reference_, span_);
}

std::optional<visualization_msgs::MarkerArray> PressurePicture::add(
    Side side, const sensor_msgs::PointCloud2& cloud) {
  const std::optional<SurfacePressure> surface = surfacePressure(cloud, side);
  if (!surface) return std::nullopt;
  const auto draw = [&](Side wing) {
    wings_[wing] = pressureMarker(*surface, wing, reference_, lift_, cloud.header.stamp);
  };
  draw(side);
  if (mirrored_ && side == Side::kRight && !bare_wing_) draw(Side::kLeft);
  visualization_msgs::MarkerArray all;
  for (Side wing : Sides{bare_wing_ ? 1U : 2U}) {
    if (!wings_[wing] || wings_[wing]->header.stamp != cloud.header.stamp) return std::nullopt;
    all.markers.push_back(*wings_[wing]);
  }
  return all;
}

}  // namespace monarch_flight
