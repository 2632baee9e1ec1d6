#pragma once
#include <Eigen/Dense>

#include "fluid/fields/slab.h"
#include "fluid/fields/team.h"
#include "fluid/pressure/symmetric_tiles.h"

namespace monarch_flight::fluid::pressure {

/// A symmetric matrix times vectors: by one process, or by the two whose slabs meet at a plane,
/// each of which keeps and reads half of it. The product is bound by reading the matrix, so that
/// two processes take half the time.
class SharedSymmetric {
 public:
  SharedSymmetric() = default;
  /// Plane k is the first one above the meeting plane.
  SharedSymmetric(SymmetricTiles matrix, const Slab& slab, int k, const Team& team);
  /// y = matrix x, the same bits on both processes. Allocates nothing; one call at a time.
  void multiply(const double* x, double* y) const;

 private:
  enum class Part { kAll, kBelow, kAbove };

  Slab slab_{1};
  Team team_;
  Part part_ = Part::kAll;
  SymmetricTiles matrix_;
  int begin_ = 0, end_ = 0;          ///< panels that this process keeps
  mutable Eigen::MatrixXd sums_;     ///< what each of them adds
  mutable Eigen::VectorXd partner_;  ///< what the other process adds
};

}  // namespace monarch_flight::fluid::pressure
