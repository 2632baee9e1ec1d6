#pragma once
#include <Eigen/Dense>
#include <vector>

namespace monarch_flight {

/// Interpolating spline of degree 5 (C4) through vector-valued samples, "not-a-knot" at both ends.
/// Value, first and second derivative are those of one function; their errors fall with the 6th,
/// 5th and 4th power of the spacing. Immutable, thread-safe.
class SmoothSpline {
 public:
  static constexpr int kDegree = 5;
  static constexpr int kLeastSamples = kDegree + 1;

  /// `t` strictly increasing, one column of `samples` for each; at least kLeastSamples.
  SmoothSpline(const std::vector<double>& t, const Eigen::MatrixXd& samples);

  struct Value {
    Eigen::VectorXd q, qd, qdd;
  };
  /// t is clamped to the ends.
  Value at(double t) const;

 private:
  using Basis = Eigen::Matrix<double, 3, kDegree + 1>;
  /// Knot interval of t: the basis functions span - kDegree ... span are non-zero there.
  int spanOf(double t) const;
  /// Non-zero basis functions (row 0) and their first and second derivatives at t.
  Basis basis(int span, double t) const;

  std::vector<double> knots_;
  Eigen::MatrixXd control_;
};

}  // namespace monarch_flight
