#pragma once
#include <memory>
#include <vector>

#include "monarch_flight/insect/numeric_table.h"
#include "monarch_flight/insect/wind_model.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

class SmoothSpline;

/// The "1 - cos" gust in time: amplitude / 2 (1 - cos(2 pi (t - begin) / duration)) for
/// begin < t < begin + duration, else nothing. Velocity and acceleration are continuous.
class TimeGust : public WindModel {
 public:
  /// begin, duration (> 0) in s; amplitude in F_I [m/s].
  TimeGust(double begin, double duration, const Eigen::Vector3d& amplitude);
  Wind at(double t, const Eigen::Vector3d& x, const Eigen::Vector3d& v,
          const Eigen::Vector3d& a) const override;
  WindRange range() const override;

 private:
  double begin_, duration_;
  Eigen::Vector3d amplitude_;
};

/// The same gust standing in space: it fills a layer of the given length behind a plane through
/// `begin`, normal to `direction`, and blows there with amplitude / 2 (1 - cos(2 pi s / length)), s
/// the distance of the body behind the plane. The whole insect is in the wind of its body's place,
/// which changes as the body moves: dW/dt = dW/ds (direction . v).
class PlaceGust : public WindModel {
 public:
  /// begin, length (> 0) in m, F_I; direction not zero; amplitude in F_I [m/s].
  PlaceGust(const Eigen::Vector3d& begin, const Eigen::Vector3d& direction, double length,
            const Eigen::Vector3d& amplitude);
  Wind at(double t, const Eigen::Vector3d& x, const Eigen::Vector3d& v,
          const Eigen::Vector3d& a) const override;
  WindRange range() const override;

 private:
  Eigen::Vector3d begin_, direction_;  // unit length
  double length_;
  Eigen::Vector3d amplitude_;
};

/// A wind by a table of samples: quintic splines (C4) through them, differentiated exactly.
class WindSeries : public WindModel {
 public:
  /// Columns t [s], wx, wy, wz (F_I [m/s]); further ones are ignored. Throws InputError naming
  /// table, row and column of every fault: fewer than 6 rows, a value that is not finite, time that
  /// does not increase, a gap (a spacing above 1.5 times the median).
  explicit WindSeries(const NumericTable& table);
  ~WindSeries() override;
  /// Throws std::out_of_range, naming the bounds, where the table does not reach.
  Wind at(double t, const Eigen::Vector3d& x, const Eigen::Vector3d& v,
          const Eigen::Vector3d& a) const override;
  /// From eight samples between any two rows and a margin for what lies between those.
  WindRange range() const override { return range_; }

  static const std::vector<std::string>& columns();
  double tBegin() const { return t_begin_; }  ///< [s]
  double tEnd() const { return t_end_; }      ///< [s]

 private:
  double t_begin_ = 0.0, t_end_ = 0.0;
  std::unique_ptr<const SmoothSpline> spline_;
  WindRange range_;
};

}  // namespace monarch_flight
