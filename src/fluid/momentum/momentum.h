#pragma once
#include <vector>

#include "fluid/fields/team.h"
#include "fluid/momentum/lines.h"
#include "fluid/momentum/plane.h"

namespace monarch_flight::fluid::momentum {

/// Implicit convection and diffusion on the staggered grid, factored by direction.
///
/// In increments delta = v* - v^n, with the convecting field c frozen within the step, the step is
///     (1 + a A_x)(1 + a A_y)(1 + a A_z) delta = (v^n - v^(n-1))/3 - a (A v^n + grad p^n / rho) ,
/// A_d v = c_d dv/dd - nu d2v/dd2, central, in a form with zero row sums (a uniform field is kept
/// exactly); the factors on the left have a small share of upwind differences. Only the last factor
/// and, in the wing's plane, the normal component see the wall's velocity at the new level; so all
/// but these is done once a step (`prepare`) and the rest for each guess of the interface
/// (`finish`). delta is affine in the wall's velocity.
class Momentum {
 public:
  Momentum(const Grid& grid, const Layout& layout, const Slab& slab, const Team& team);

  /// Does what does not depend on the wall's new velocity.
  void prepare(const MomentumStep& step, const ExplicitSide& side);
  /// v* for the wall's change of velocity; wing faces and outer faces as given by the caller
  /// afterwards. After the first call since `prepare` lines that do not see the wall are left as
  /// they stand in v_star.
  void finish(const Velocity& vn, const Velocity& c, const WallVelocity& wall_change,
              Velocity& v_star);

  const Metrics& metrics() const { return metrics_; }
  const MomentumStep& step() const { return step_; }

 private:
  Lines lines(const Velocity& vn, const Velocity& c, int component, double* reduced,
              Velocity& v_star);
  LineRange block(int component, int index) const;
  static constexpr int kRowsZ = 8;  ///< rows of lines solved together: few enough for the cache

  int blocks(int component) const;
  void solveBlock(Lines lines, const LineRange& range, const WallVelocity& wall_change, int thread);
  void finishNormal(const Lines& lines, const WallVelocity& wall_change);
  void finishSlabs(const Lines& lines, const WallVelocity& wall_change);

  const Metrics metrics_;
  const Layout& layout_;
  const Slab& slab_;
  const Team& team_;
  MomentumStep step_{};
  bool first_ = true;  ///< `finish` was not called since `prepare`
  Velocity delta_;  ///< after the x and y factors; of w also reduced, where one process has it all
  Array wing_plane_;                  ///< right side of w in the wing's plane, before any factor
  std::vector<LineRange> seen_[2];    ///< of the blocks of u and v: the points that see the wall
  std::vector<PlaneScratch> planes_;  ///< one a thread
  std::vector<Array> gammas_;         ///< of a block of lines, one a thread
  Array gamma_field_;  ///< of all lines: of w; of any component where several processes share them
  /// Planes, see Lines: of each component, since lines of u and v are solved at the same time.
  Array behind_[3], solved_[3][2];
};

}  // namespace monarch_flight::fluid::momentum
