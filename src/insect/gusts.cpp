#include "monarch_flight/insect/gusts.h"

#include <cmath>
#include <utility>

namespace monarch_flight {
namespace {

/// (1 - cos(2 pi s / length)) / 2 between 0 and length, 0 elsewhere, and its derivative by s.
struct Bump {
  Bump(double s, double length) {
    if (!(s > 0.0 && s < length)) return;
    const double half = M_PI * s / length;
    value = std::sin(half) * std::sin(half);
    slope = M_PI / length * std::sin(2.0 * half);
  }
  double value = 0.0, slope = 0.0;
};

}  // namespace

WindSum::WindSum(std::vector<std::shared_ptr<const WindModel>> parts) : parts_(std::move(parts)) {}

Wind WindSum::at(double t, const Eigen::Vector3d& x, const Eigen::Vector3d& v,
                 const Eigen::Vector3d& a) const {
  Wind sum;
  for (const auto& part : parts_) {
    const Wind one = part->at(t, x, v, a);
    sum.v += one.v;
    sum.a += one.a;
  }
  return sum;
}

WindRange WindSum::range() const {
  WindRange sum;
  for (const auto& part : parts_) {
    const WindRange one = part->range();
    sum.middle += one.middle;
    sum.spread += one.spread;
  }
  return sum;
}

TimeGust::TimeGust(double begin, double duration, const Eigen::Vector3d& amplitude)
    : begin_(begin), duration_(duration), amplitude_(amplitude) {}

Wind TimeGust::at(double t, const Eigen::Vector3d&, const Eigen::Vector3d&,
                  const Eigen::Vector3d&) const {
  const Bump bump(t - begin_, duration_);
  return {amplitude_ * bump.value, amplitude_ * bump.slope};
}

/// All its velocities lie on the way from zero to the amplitude.
WindRange TimeGust::range() const { return {0.5 * amplitude_, 0.5 * amplitude_.norm()}; }

PlaceGust::PlaceGust(const Eigen::Vector3d& begin, const Eigen::Vector3d& direction, double length,
                     const Eigen::Vector3d& amplitude)
    : begin_(begin), direction_(direction.normalized()), length_(length), amplitude_(amplitude) {}

Wind PlaceGust::at(double, const Eigen::Vector3d& x, const Eigen::Vector3d& v,
                   const Eigen::Vector3d&) const {
  const Bump bump(direction_.dot(x - begin_), length_);
  return {amplitude_ * bump.value, amplitude_ * (bump.slope * direction_.dot(v))};
}

WindRange PlaceGust::range() const { return {0.5 * amplitude_, 0.5 * amplitude_.norm()}; }

}  // namespace monarch_flight
