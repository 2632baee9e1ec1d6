#pragma once
#include <algorithm>

#include "fluid/fields/field.h"
#include "fluid/fields/frame.h"
#include "fluid/momentum/interleave.h"

namespace monarch_flight::fluid::momentum {

/// Constants of one momentum step.
struct MomentumStep {
  double a;           ///< dt (first step) or 2 dt / 3: the factor of the new level's right side [s]
  double dt;          ///< [s]
  double nu;          ///< kinematic viscosity [m^2/s]
  double rho;         ///< [kg/m^3]
  bool second_order;  ///< BDF2; false: implicit Euler
};

/// Implicit convection and diffusion on the staggered grid, factored by direction.
///
/// In increments delta = v* - v^n, with the convecting field c frozen within the step, the step is
///     (1 + a A_x)(1 + a A_y)(1 + a A_z) delta = (v^n - v^(n-1))/3 - a (A v^n + grad p^n / rho) ,
/// A_d v = c_d dv/dd - nu d2v/dd2, central, in a form with zero row sums (a uniform field is kept
/// exactly); the factors on the left have a small share of upwind differences. Only the last factor
/// and, in the wing's plane, the normal component see the wall's velocity at the new level; so all
/// but these is done once a step
/// (`prepare`) and the rest for each guess of the interface (`finish`). delta is affine in the
/// wall's velocity.
class Momentum {
 public:
  Momentum(const Grid& grid, const Layout& layout, const Slab& slab);

  /// Does what does not depend on the wall's new velocity. `vn`, `vm`: levels n and n-1; `c`:
  /// convecting field; `p`: pressure at n (layout of cells = faces (i,j,k)); `wall_n`: the wall at
  /// level n.
  void prepare(const MomentumStep& step, const Velocity& vn, const Velocity& vm, const Velocity& c,
               const Array& p, const WallVelocity& wall_n);
  /// v* for the wall's change of velocity; wing faces and outer faces as given by the caller
  /// afterwards.
  void finish(const Velocity& vn, const Velocity& c, const WallVelocity& wall_change,
              Velocity& v_star);

  /// a A v of the normal component on the wing's faces of row j, `out` of nx; v* and the convecting
  /// field with their neighbouring planes. On the process that owns the plane k_wing.
  void normalTransport(const Velocity& c, const Velocity& v_star, int j, double* out);

  /// Share (0, 1/2, 1) of the z-face below the point (i, j, k_wing) of component u, v or w that is
  /// wing.
  double blocked(int component, int i, int j) const {
    return blocked_[component][static_cast<std::size_t>((j + 1) * layout_.sy + i + 8)];
  }

 private:
  struct Direction {
    Array inverse_width;     ///< 1 / control-volume width, at the points of the component
    Array inverse_distance;  ///< 1 / distance to the lower neighbour; one entry more than points
  };
  struct Row {  ///< off-diagonals of a A_d along one row (x runs)
    double* lower;
    double* upper;
  };
  /// First and last unknown of a component along a direction; along z those of this process.
  int first(int component, int direction) const {
    const int whole = component == direction ? 1 : 0;
    return direction == 2 ? std::max(whole, layout_.k0) : whole;
  }
  int last(int, int direction) const {
    return (direction == 2 ? layout_.k1 : layout_.n(direction)) - 1;
  }
  double position(int component, int direction, int index) const;

  void rowFaces(const Velocity& c, int component, int direction, int j, int k, double* above,
                double* below) const;
  void coefficientsX(const Velocity& c, int component, int j, int k, Row row);
  void coefficientsY(const Velocity& c, int component, int j, int k, Row row);
  void faceBehindZ(const Velocity& c, int component, int j, int k, int towards,
                   double* behind) const;
  void coefficientsZ(const Velocity& c, int component, int j, int k, int towards, double* behind,
                     Row row) const;
  /// d -= a A v along a row, all but the wall's shear; `v` and `d` begin at the point (0, j, k).
  void subtractTransport(const Velocity& c, int component, int j, int k, const double* v,
                         double* d) const;
  void subtractFourthDifferences(const Velocity& c, int component, int j, int k, const double* v,
                                 double* d) const;
  void addWallShear(const WallVelocity& wall, int component, int j, int k, const double* v,
                    double* d);
  void rightSide(const Velocity& vn, const Velocity& vm, const Velocity& c, const Array& p,
                 const WallVelocity& wall_n, int component, int j, int k);
  void cutAtWing(int component, int j, int k, double* off, double* diagonal) const;
  /// Beside the rim: the inertia of a face is 1 / mobility. Scales what a row has beyond inertia.
  void mobilise(int component, int j, int k, std::initializer_list<double*> terms) const {
    const double* m = grid_.mobility.row(component, j, k);
    if (!m) return;
    for (double* term : terms) {
      for (int i = 0; i < layout_.nx; ++i) term[i] *= m[i];
    }
  }
  void fixWingFaces(const WallVelocity& wall_change, int j, Row row, double* d) const;

  /// Calls fill(j, x, y) for the rows of plane k of delta, to set their right sides and their
  /// coefficients along x and y, and (if `swept`) solves both factors, eight rows at a time while
  /// they are in the cache.
  template <class Fill>
  void solvePlane(int component, int k, bool swept, Fill fill) {
    const int end = last(component, 1) + 1;
    for (int j = first(component, 1); j < end; j += kLines) {
      const int lines = std::min(kLines, end - j);
      for (int l = 0; l < lines; ++l) fill(j + l, xRow(l), yRow(l));
      if (swept) solveRows(component, j, k, lines);
    }
    if (swept) substituteY(component, k);
  }
  Row xRow(int l) { return {&x_lower_[l * layout_.sy], &x_upper_[l * layout_.sy]}; }
  Row yRow(int l) { return {&y_lower_[l * layout_.sy], &y_upper_[l * layout_.sy]}; }
  void solveRows(int component, int j, int k, int lines);
  void sweepX(int component, double* rows, int lines);
  void eliminateY(int component, int j, Row row, double* d);
  void substituteY(int component, int k);

  /// The z factor: eliminated from both ends to the wing's plane, solved there, substituted
  /// outwards; v* = v^n + delta.
  void sweepZ(const Velocity& c, const WallVelocity& wall_change, int component, const Velocity& vn,
              Velocity& v_star);
  struct Lines;  ///< the factors and right sides of the lines of one component
  void eliminateRow(const Velocity& c, const WallVelocity& wall_change, const Lines& lines, int j,
                    int k, int towards);
  struct RowRange {
    int first, last;
  };
  void eliminate(const Velocity& c, const WallVelocity& wall_change, const Lines& lines,
                 RowRange rows, int half);
  void join(const Lines& lines, RowRange rows) const;
  void substitute(const Lines& lines, RowRange rows, int half) const;
  void addLevel(const Lines& lines, const Velocity& vn, RowRange rows) const;

  /// Lines of z that one process solves together: neighbours in memory, few enough for the cache.
  static constexpr int kRowsZ = 4;

  const Grid& grid_;
  const Layout& layout_;
  const Slab& slab_;
  Direction metric_[3][3];  ///< [component][direction]
  Array blocked_[3];        ///< per component, one plane
  MomentumStep step_{};
  Velocity delta_;    ///< after the x and y factors
  Array wing_plane_;  ///< right side of w in the wing's plane, before any factor
  // Scratch: single rows, two rows of faces, blocks of kLines rows, and such blocks interleaved
  Array lower_, upper_, wall_diagonal_, wall_side_, zero_, x_above_, x_below_, one_;
  Array y_above_, y_below_;
  Array x_lower_, x_upper_, y_lower_, y_upper_;
  Array lane_lower_, lane_upper_, lane_gamma_, lane_side_;
  Array gamma_;     ///< factors of a plane
  Array z_behind_;  ///< stencils of a plane of z-faces
  mutable Array next_;
  Array fourth_x_[3];  ///< per component: 1 / width where fourth differences along x reach, else 0
  Array gamma_field_;  ///< factors of all lines; only where several processes share them
};

}  // namespace monarch_flight::fluid::momentum
