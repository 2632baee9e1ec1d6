#include "monarch_flight/viz/wing_pressure.h"

#include <algorithm>
#include <cmath>

#include "monarch_flight/viz/colours.h"
#include "monarch_flight/viz/frames.h"
#include "viz/marker.h"

namespace monarch_flight {
namespace {

constexpr int kRows = 42, kColumns = 16;
constexpr double kLift = 0.004;  // of the coloured sides off the wing [mean chords]

void addSide(const WingSheet& sheet, const std::vector<double>& cp, double mirror, double z,
             double limit, visualization_msgs::Marker& out) {
  const auto corner = [&](int row, int column) -> Corner {
    const Eigen::Vector2d& p = sheet.at(row, column);
    const auto n = static_cast<std::size_t>(row * sheet.columns() + column);
    return {Eigen::Vector3d(p.x(), mirror * p.y(), z).cast<float>(), pressureColour(cp[n] / limit)};
  };
  for (int i = 0; i + 1 < sheet.rows(); ++i) {
    for (int j = 0; j + 1 < sheet.columns(); ++j) {
      const Corner a = corner(i, j), b = corner(i, j + 1), c = corner(i + 1, j + 1),
                   d = corner(i + 1, j);
      addTriangle(out, a, b, c);
      addTriangle(out, a, c, d);
    }
  }
}

}  // namespace

WingPressure::WingPressure(const Case& c, Side side)
    : sheet_(c.insect.wings[side].planform, kRows, kColumns),
      per_pascal_(1.0 / pressureReference(c).dynamic),
      lift_(kLift * c.insect.meanChord()) {}

void WingPressure::take(const SurfacePressure& surface) {
  if (!means_ || !means_->fits(surface)) means_.emplace(surface, sheet_.points());
  upper_ = means_->of(surface, &SurfacePressure::Facet::p_upper);
  lower_ = means_->of(surface, &SurfacePressure::Facet::p_lower);
  for (std::vector<double>* side : {&upper_, &lower_})
    for (double& value : *side) value *= per_pascal_;
}

double WingPressure::largest() const {
  std::vector<double> sizes;
  for (const std::vector<double>* side : {&upper_, &lower_})
    for (double value : *side) sizes.push_back(std::abs(value));
  if (sizes.empty()) return 0.0;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(0.98 * double(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at;
}

visualization_msgs::Marker WingPressure::marker(Side side, double limit,
                                                const ros::Time& stamp) const {
  const bool left = side == Side::kLeft;
  visualization_msgs::Marker out =
      triangleList(left ? frames::kLeftWing : frames::kRightWing, "pressure", left ? 1 : 0, stamp);
  out.frame_locked = true;
  const double mirror = left ? -1.0 : 1.0;
  addSide(sheet_, upper_, mirror, -lift_, limit, out);
  addSide(sheet_, lower_, mirror, lift_, limit, out);
  return out;
}

}  // namespace monarch_flight
