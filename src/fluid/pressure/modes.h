#pragma once
#include <Eigen/Dense>
#include <vector>

#include "monarch_flight/fluid/grid.h"

namespace monarch_flight::fluid::pressure {

/// Modes of one parity of an axis: column a of `vectors` holds mode a on the first m cells.
struct ModeClass {
  Eigen::MatrixXd vectors;  ///< m x m
  Eigen::VectorXd values;   ///< m eigenvalues >= 0 [1/m^2], ascending
  int m() const { return static_cast<int>(values.size()); }
};

/// Generalised eigenvectors of one axis: K u = lambda W u with K the face conductances 1 / gap and
/// W = diag(width), scaled to u^T W u = 1 over all n cells.
/// An axis symmetric about its middle with n even is split: class 0 holds the modes even about the
/// middle, class 1 the odd ones, both on the first half only. Else there is one class of n modes.
/// With closed ends (no conductance through the outer faces) the first mode is exactly constant and
/// its eigenvalue exactly 0.
class AxisModes {
 public:
  AxisModes(const Axis& axis, bool open_ends);
  int n() const { return n_; }
  bool split() const { return classes_.size() == 2; }
  const std::vector<ModeClass>& classes() const { return classes_; }
  /// All modes, class after class, on the cells [first, first + count): count x n.
  Eigen::MatrixXd rows(int first, int count) const;

 private:
  int n_;
  std::vector<ModeClass> classes_;
};

}  // namespace monarch_flight::fluid::pressure
