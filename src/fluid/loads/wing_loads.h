#pragma once
#include "fluid/fields/field.h"
#include "fluid/fields/slab.h"
#include "fluid/momentum/momentum.h"
#include "monarch_flight/fluid/fluid_model.h"

namespace monarch_flight::fluid::loads {

/// The wing's surface pressure at one level, seen from the cells that touch it.
///
/// The pressure at the wall follows from the cells' by the wall-normal momentum equation,
/// dp/dz = - rho a_n, a_n the wall's own normal acceleration: second order in the height of the
/// cell.
class WingPressure {
 public:
  /// `p` with layout `l` (may be null) plus `phi` without ghosts (may be null).
  WingPressure(const Grid& grid, const Layout& l, const double* p, const double* phi)
      : grid_(grid), l_(l), p_(p), phi_(phi) {}
  double below(int i, int j, double rho, double a_n) const {  ///< on the side z < 0 [Pa]
    return cell(i, j, grid_.k_wing - 1) - 0.5 * grid_.z.width[grid_.k_wing - 1] * rho * a_n;
  }
  double above(int i, int j, double rho, double a_n) const {  ///< on the side z > 0 [Pa]
    return cell(i, j, grid_.k_wing) + 0.5 * grid_.z.width[grid_.k_wing] * rho * a_n;
  }

 private:
  double cell(int i, int j, int k) const {
    const double base = p_ ? p_[l_.at(i, j, k)] : 0.0;
    return phi_ ? base + phi_[(static_cast<std::ptrdiff_t>(k - l_.k0) * l_.ny + j) * l_.nx + i]
                : base;
  }
  const Grid& grid_;
  const Layout& l_;
  const double* p_;
  const double* phi_;
};

/// The loads of the sides of the wing that touch cells of this process; to be summed over
/// processes.

/// Force and moment (about the origin) of the pressure jump.
void pressureLoads(const Grid& grid, const Layout& l, const WingPressure& p, double rho,
                   const WallVelocity& acceleration, Loads& loads);
/// Force and moment of the shear on both sides. `v` minus `scale` grad `phi` is the velocity.
void frictionLoads(const Grid& grid, const Layout& l, const momentum::Metrics& metrics,
                   const Velocity& v, const double* phi, double scale, const WallVelocity& wall,
                   double mu, Loads& loads);
/// Adds to the friction what the air on the wing's own faces (half a cell on both sides) takes from
/// its neighbours by normal stress and convection: next to nothing inside the outline, but not at
/// the rim. With it the loads are what the air around the wing loses. `row` is scratch of nx.
void rimLoads(const Grid& grid, const Layout& l, const momentum::Momentum& momentum,
              const Velocity& convecting, const Velocity& v_star, double rho_by_a, double* row,
              Loads& loads);
/// Of all processes, on each of them.
void sumLoads(const Slab& slab, Loads& loads);

}  // namespace monarch_flight::fluid::loads
