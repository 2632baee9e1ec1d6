#pragma once
#include <Eigen/Dense>
#include <vector>

#include "fluid/fields/slab.h"
#include "fluid/fields/team.h"

namespace monarch_flight::fluid::pressure {

/// A symmetric matrix times vectors: by one process, or by the two whose slabs meet at a plane,
/// each of which keeps and reads half of it,  [A, B^T; B, C] = [A, B^T; B, 0] + [0, 0; 0, C].  The
/// product is bound by reading the matrix, so that two processes take half the time.
class SharedSymmetric {
 public:
  SharedSymmetric() = default;
  /// Of `matrix` only the lower triangle counts. Plane k is the first one above the meeting plane.
  SharedSymmetric(Eigen::MatrixXd matrix, const Slab& slab, int k, const Team& team);
  /// y = matrix x, the same bits on both processes. Allocates nothing; one call at a time.
  void multiply(const double* x, double* y) const;

 private:
  enum class Part { kAll, kBelow, kAbove };

  void multiplyAll(const double* x, double* y) const;
  void multiplyBelow(const double* x, double* y) const;

  Slab slab_{1};
  Team team_;
  Part part_ = Part::kAll;
  int n_ = 0, split_ = 0;            ///< rows; rows of A
  Eigen::MatrixXd held_;             ///< all; or A over B; or the columns of C, n rows each
  std::vector<int> ends_;            ///< of all: shares of the columns, the same for any team
  mutable Eigen::MatrixXd sums_;     ///< what each share adds
  mutable Eigen::VectorXd partner_;  ///< what the other process adds
};

}  // namespace monarch_flight::fluid::pressure
