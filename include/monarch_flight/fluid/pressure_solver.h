#pragma once
#include <memory>
#include <vector>

#include "monarch_flight/fluid/grid.h"
#include "monarch_flight/fluid/kernel_times.h"

namespace monarch_flight {

namespace fluid {
class Slab;
class Team;
}  // namespace fluid

/// Direct solver of the Poisson equation on a Grid with a wing.
///
/// Finds p with, for every cell c:
///   sum over its faces f of mobility_f (area_f / gap_f) (p_neighbour - p_c) = b_c ,
/// where faces of the wing contribute nothing (mobility 0; beside its rim more than 1), outer faces
/// contribute nothing (grid.open == false) or (area / half width) (0 - p_c) (grid.open == true). b
/// is integrated over the cell. With grid.open == false b must sum to zero up to rounding (the
/// residual mean is removed) and p has zero volume mean.
///
/// Method: fast diagonalisation in x and y (generalised eigenvectors), tridiagonal elimination in z
/// from both ends to the wing plane, dense capacitance matrix on the faces of the wing and of its
/// rim between elimination and back-substitution: one forward and one inverse transform a solve.
/// b has the unit of p times metre.
class PressureSolver {
 public:
  /// Sets BLAS to one thread for the whole process (repeatable bit for bit). Throws
  /// std::invalid_argument when the wing closes the whole plane of a closed box.
  explicit PressureSolver(const Grid& grid);
  /// On the processes of a slab, `solve` then sees the planes of this process
  /// only, by a team of threads, and all processes call it alike; `apply` is for one process that
  /// owns all.
  PressureSolver(const Grid& grid, const fluid::Slab& slab, const fluid::Team& team);
  ~PressureSolver();
  PressureSolver(const PressureSolver&) = delete;
  PressureSolver& operator=(const PressureSolver&) = delete;

  /// In place: b in, p out; nx*ny*nz doubles, x fastest, best 64-byte aligned. Allocates nothing.
  /// Uses scratch of this object: one call at a time.
  void solve(double* b_to_p) const;
  /// The first part of `solve`, for callers that need the pressure at the wing for several b and
  /// the whole field for the last one only: p in the two planes of cells next to the wing's plane
  /// (up to a constant where the outer faces are closed); b stays in the others. Costs the forward
  /// transform. Adds the time of its parts to `times`. As `solve`: all processes call it, one call
  /// at a time, nothing is allocated.
  void solveAtWing(double* b_to_p, KernelTimes& times) const;
  /// The second part: p in all planes, for the b of the last `solveAtWing`. Costs the inverse
  /// transform. Throws std::logic_error when there was none since the last solution.
  void complete(double* p, KernelTimes& times) const;
  /// y = A p, the operator above, for checks (any p).
  void apply(const double* p, double* y) const;

  int wingFaces() const;  ///< n_w
  double setupSeconds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace monarch_flight
