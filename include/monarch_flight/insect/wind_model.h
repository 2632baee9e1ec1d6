#pragma once
#include <memory>
#include <vector>

#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// What the velocity of a wind can be: at every time and place within `spread` of `middle`.
struct WindRange {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< F_I [m/s]
  double spread = 0.0;                               ///< [m/s]
};

/// The wind of a run: uniform in space at every time, as seen at the insect. Immutable,
/// thread-safe.
class WindModel {
 public:
  virtual ~WindModel() = default;
  /// At time t [s] and the body's place x, moving at v and a (F_I; [m], [m/s], [m/s^2]): a gust
  /// that stands in the way is met at that speed, so the wind's acceleration follows from them.
  virtual Wind at(double t, const Eigen::Vector3d& x, const Eigen::Vector3d& v,
                  const Eigen::Vector3d& a) const = 0;
  /// What `at` can answer: the air's speed past a wing at velocity v is at most
  /// |v - middle| + spread.
  virtual WindRange range() const = 0;
};

/// The same wind at all times.
class SteadyWind : public WindModel {
 public:
  explicit SteadyWind(const Eigen::Vector3d& wind_I = Eigen::Vector3d::Zero())
      : wind_{wind_I, {0, 0, 0}} {}
  Wind at(double, const Eigen::Vector3d&, const Eigen::Vector3d&,
          const Eigen::Vector3d&) const override {
    return wind_;
  }
  WindRange range() const override { return {wind_.v, 0.0}; }

 private:
  Wind wind_;
};

/// Several winds, one on top of the other.
class WindSum : public WindModel {
 public:
  /// None of them null.
  explicit WindSum(std::vector<std::shared_ptr<const WindModel>> parts);
  Wind at(double t, const Eigen::Vector3d& x, const Eigen::Vector3d& v,
          const Eigen::Vector3d& a) const override;
  WindRange range() const override;

 private:
  std::vector<std::shared_ptr<const WindModel>> parts_;
};

}  // namespace monarch_flight
