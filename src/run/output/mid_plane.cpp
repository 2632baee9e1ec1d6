#include "monarch_flight/run/mid_plane.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace monarch_flight {
namespace {

constexpr double kInner = 0.1;  // of the span: at the root the wings stand beside each other
constexpr int kStations = 32;
constexpr double kRounding = 1e-9;  // of the span

std::vector<Eigen::Vector3d> rim(const Planform& wing) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= kStations; ++i) {
    const double y = wing.yRoot() + wing.span() * (kInner + (1 - kInner) * i / kStations);
    points.emplace_back(wing.leading(y), y, 0.0);
    points.emplace_back(wing.trailing(y), y, 0.0);
  }
  return points;
}

}  // namespace

MidPlane::MidPlane(const Case& c) : insect_(c.insect), sides_(c.sides()) {
  if (insect_.bare_wing) return;
  for (Side side : sides_) rim_[side] = rim(insect_.wings[side].planform);
}

void MidPlane::add(const CommittedStep& step) {
  if (insect_.bare_wing) return;
  double depth = 0.0;
  for (Side side : sides_) {  // the left one in the mirror, where it is a right one
    const Eigen::Matrix3d R_BW = wingAttitude(Side::kRight, insect_.beta, step.angles.wings[side]);
    const double root = insect_.wings[side].plate.mu.y();
    for (const Eigen::Vector3d& point : rim_[side])
      depth = std::max(depth, -root - R_BW.row(1).dot(point));
    if (depth < kRounding * insect_.wings[side].planform.span()) depth = 0.0;
  }
  ++steps_;
  beyond_ += depth > 0.0 ? 1 : 0;
  depth_ = std::max(depth_, depth);
}

void MidPlane::memory(StateVisitor& state) {
  state("mid_plane_depth", depth_);
  state("mid_plane_steps", steps_);
  state("mid_plane_beyond", beyond_);
}

std::string MidPlane::remark() const {
  if (depth_ == 0.0) return "";
  std::ostringstream text;
  text
      << std::fixed << std::setprecision(1)
      << "the wings pass through the insect's mid-plane by up to " << 1e3 * depth_ << " mm, in "
      << 100 * share()
      << " % of the steps; the air of each wing is computed alone, so do not trust the loads there "
      << "(docs/validation.md, What is not modelled)";
  return text.str();
}

}  // namespace monarch_flight
