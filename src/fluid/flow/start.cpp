// How a flow is made and set going.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "fluid/fields/projection.h"
#include "fluid/flow/flow.h"
#include "fluid/loads/wing_loads.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight::fluid {
namespace {

constexpr int kMostParts = 100;       // of a step
constexpr double kEasyCourant = 1.0;  // of their parts
constexpr double kMostGrowth = 2.0;   // of lengths, from one part to the next; BDF2 bears 2.4

}  // namespace

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
  dt_ = length_ = dt;
  length_before_ = 0;
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
  setLevelBefore(motion.a_W - motion.omega_W.cross(level_n_.grid.V), motion.alpha_W);
  potentialStart();
  vm_ = vn_;
}

/// Level -1 by the motion's own rates, so that the first extrapolation is of second order too.
void NavierStokes::setLevelBefore(const Eigen::Vector3d& V_dot, const Eigen::Vector3d& omega_dot) {
  const GridVelocity& n = level_n_.grid;
  level_m_ = level_n_;
  level_m_.grid.V -= length_ * V_dot;
  level_m_.grid.omega -= length_ * omega_dot;
  level_m_.place.linear() = level_n_.place.linear() * expSO3(-length_ * n.omega);
  level_m_.place.translation() -= length_ * (level_n_.place.linear() * n.V);
}

/// The air is fast round the rim of a wing that is set in motion at once, until a vortex has grown
/// there, which it has when the wing has moved by a chord. In as many steps as the chord has cells,
/// while what is left of a step takes the air across more than a cell, parts of the step are taken
/// before it; lengths at most double. In them the wing moves on to where the step's first
/// evaluation has it, so that all evaluations of the step share them.
void NavierStokes::easeIn(const WingMotion& next) {
  if (known_) return;  // nothing was set in motion
  const Axis &x = grid_.x, &y = grid_.y;
  const double cell = std::min(*std::min_element(x.width.begin(), x.width.end()),
                               *std::min_element(y.width.begin(), y.width.end()));
  const bool starts = steps_ * cell < reference_length_;
  for (int parts = 0;; ++parts) {
    double part = length_before_ > 0 ? kMostGrowth * length_before_ : length_;
    if (starts) {
      convectingField(level_n_.grid);
      const double cells = courant();
      if (cells > kEasyCourant) part = std::min(part, length_ * kEasyCourant / cells);
    }
    if (part >= length_) return;
    if (parts == kMostParts)
      throw NumericalError("Navier-Stokes: step " + std::to_string(steps_ + 1) +
                           " is not done in " + std::to_string(kMostParts) +
                           " parts, the start is too fast for this grid: use more steps a flap, a "
                           "coarser grid, or let the motion set in gradually");
    takePart(std::min(part, 0.5 * length_), next);
  }
}

/// The beginning of the step that is left to be done.
void NavierStokes::takePart(double part, const WingMotion& next) {
  const GridVelocity n = level_n_.grid, m = level_m_.grid;
  const double share = part / length_;
  struct Rest {  // also where the part fails
    double& length;
    long& steps;
    momentum::MomentumStep& step;
    const double left = length;
    const long done = steps;
    double taken = 0;
    ~Rest() { length = left - taken, steps = done, step = {}; }
  } rest{length_, steps_, step_};
  length_ = part;
  if (length_before_ == 0) setLevelBefore((n.V - m.V) / rest.left, (n.omega - m.omega) / rest.left);
  WingMotion wing;
  wing.v_W = n.V + share * (next.v_W - n.V);
  wing.omega_W = n.omega + share * (next.omega_W - n.omega);
  wing.R_IW = level_n_.place.linear() * expSO3(0.5 * part * (n.omega + wing.omega_W));
  wing.r_I = level_n_.place.translation() +
             0.5 * part * (level_n_.place.linear() * n.V + wing.R_IW * wing.v_W);
  prepareStep();
  solve(wing);
  complete();
  rest.taken = part;
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
