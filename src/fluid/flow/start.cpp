// How a flow is made and set going.
#include <algorithm>
#include <utility>

#include "fluid/fields/projection.h"
#include "fluid/flow/flow.h"
#include "fluid/loads/wing_loads.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight::fluid {

NavierStokes::NavierStokes(Grid grid, const Air& air, double reference_length, double courant_limit,
                           MPI_Comm comm, int threads)
    : grid_(std::move(grid)),
      slab_(comm == MPI_COMM_NULL ? Slab(grid_.z.n()) : Slab(comm, grid_.z.n())),
      team_(threads),
      layout_(grid_, slab_),
      air_(air),
      reference_length_(reference_length),
      courant_limit_(courant_limit),
      pressure_(grid_, slab_, team_),
      momentum_(grid_, layout_, slab_, team_),
      vn_(layout_),
      vm_(layout_),
      p_(layout_.size(), 0.0),
      convecting_(layout_),
      v_star_(layout_) {
  const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(layout_.nx) * layout_.ny;
  row_.assign(layout_.nx, 0.0);
  rates_.assign(slab_.planes(), 0.0);
  phi_start_ = (plane + 7) / 8 * 8;
  phi_.assign(phi_start_ + plane * slab_.planes(), 0.0);
  added_mass_ = computeAddedMass();
}

Matrix6d NavierStokes::computeAddedMass() {
  Matrix6d m = Matrix6d::Zero();
  for (int column : {2, 3, 4}) {  // only motion normal to the wing moves the air without friction
    GridVelocity unit;
    (column == 2 ? unit.V.z() : column == 3 ? unit.omega.x() : unit.omega.y()) = 1;
    const WallVelocity wall = wallVelocity(unit);
    fillWing(grid_, layout_, wall, v_star_);
    netOutflow(grid_, layout_, team_, v_star_, air_.rho, phi());
    pressure_.solve(phi());
    Loads loads;
    pressureLoads(grid_, layout_, loads::WingPressure(grid_, layout_, nullptr, phi()), air_.rho,
                  wall, loads);
    loads::sumLoads(slab_, loads);
    m.col(column) << -loads.force_pressure, -loads.moment_pressure;
  }
  fillWing(grid_, layout_, WallVelocity{}, v_star_);
  return m;
}

void NavierStokes::start(const WingMotion& motion, double dt) {
  dt_ = dt;
  steps_ = 0;
  report_.kernel_s.fill(0.0);
  report_.divergence = 0.0;
  prepared_ = evaluated_ = false;
  for (Velocity* v : {&vn_, &v_star_}) {
    for (Array& a : v->c) std::fill(a.begin(), a.end(), 0.0);
  }
  std::fill(p_.begin(), p_.end(), 0.0);
  committed_acceleration_ = {};
  level_n_.axes = motion.R_IW;
  level_n_.grid = gridVelocity(motion);
  level_n_.wall = wallVelocity(level_n_.grid);
  level_n_.place = placeOf(motion);
  known_ = nullptr;
  level_m_ = level_n_;
  // Level -1 by the motion's own rates, so that the first extrapolation is of second order too.
  const Eigen::Vector3d V_dot = motion.a_W - motion.omega_W.cross(level_n_.grid.V);
  level_m_.grid.V -= dt * V_dot;
  level_m_.grid.omega -= dt * motion.alpha_W;
  level_m_.place.linear() = level_n_.place.linear() * expSO3(-dt * motion.omega_W);
  level_m_.place.translation() -= dt * (level_n_.place.linear() * level_n_.grid.V);
  potentialStart();
  vm_ = vn_;
}

/// The wing is set in motion at once: the air takes up the potential flow of its normal velocity.
void NavierStokes::potentialStart() {
  fillWing(grid_, layout_, level_n_.wall, vn_);
  netOutflow(grid_, layout_, team_, vn_, 1.0, phi());
  pressure_.solve(phi());
  fillPhiHalo();
  subtractGradient(grid_, layout_, team_, phi(), 1.0, vn_);
  fillHalo(layout_, slab_, vn_);
}

void NavierStokes::setKnownFlow(KnownFlow flow) {
  known_ = std::move(flow);
  for (Velocity* v : {&vn_, &vm_}) {
    const bool now = v == &vn_;
    const Eigen::Isometry3d& place = now ? level_n_.place : level_m_.place;
    for (int c = 0; c < 3; ++c) {
      for (int k = layout_.k0 - 1; k <= layout_.k1; ++k) {
        for (int j = -1; j <= layout_.ny; ++j) {
          for (int i = -1; i <= layout_.nx; ++i) {
            const Eigen::Vector3d r_I = place * pointOf(grid_, c, i, j, k);
            v->c[c][layout_.at(i, j, k)] = level_n_.axes.col(c).dot(known_(r_I, now ? 0 : -dt_));
          }
        }
      }
    }
  }
}

}  // namespace monarch_flight::fluid
