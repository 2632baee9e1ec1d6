#pragma once
#include "fluid/fields/frame.h"
#include "fluid/momentum/metrics.h"
#include "fluid/momentum/stencil.h"

namespace monarch_flight::fluid::momentum {

/// What the explicit side of a momentum step is made of.
struct ExplicitSide {
  const Velocity& vn;  ///< level n
  const Velocity& vm;  ///< level n-1
  const Velocity& c;   ///< convecting field
  const Array& p;      ///< pressure at n, of cells = faces (i, j, k)
  WallVelocity wall_n;
};

/// What the row (j, k) of a component leaves for its implicit factors, all beginning at i = 0.
struct RowFactors {
  double* x_sum;    ///< twice the velocity through the lower faces along x; one more than points
  double* y_lower;  ///< off-diagonals of a A_y
  double* y_upper;
  const double* y_sum;    ///< of the lower faces along y, from the row before
  const double* y_above;  ///< and their stencils
  double* y_sum_next;     ///< of the upper faces
  double* y_above_next;
};

/// The lower faces along y of row (j, k), for its first row in a plane.
void firstFacesY(const Metrics& m, const MomentumStep& step, const Velocity& c, int component,
                 int j, int k, double* sum, double* above);

/// d = (v^n - v^(n-1)) / 3 - a (A v^n + grad p / rho) less the fourth differences, and the factors,
/// of row (j, k) in one pass; off-diagonals along x are formed when they are solved (plane.cpp).
void formRow(const Metrics& m, const MomentumStep& step, const ExplicitSide& side, int component,
             int j, int k, double* d, const RowFactors& out);

/// The factors of row (j, k) alone.
void formFactors(const Metrics& m, const MomentumStep& step, const Velocity& c, int component,
                 int j, int k, const RowFactors& out);

/// a A v of the normal component on the wing's faces of row j, `out` of nx, 0 elsewhere; v and the
/// convecting field with their neighbouring planes. On the process that owns the plane k_wing.
void normalTransport(const Metrics& m, const MomentumStep& step, const Velocity& c,
                     const Velocity& v, int j, double* out);

}  // namespace monarch_flight::fluid::momentum
