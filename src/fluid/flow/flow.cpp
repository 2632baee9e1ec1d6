#include "fluid/flow/flow.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "fluid/fields/projection.h"
#include "fluid/loads/wing_loads.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight::fluid {

namespace {

constexpr long kDivergenceEvery = 50;  // steps: a look at all velocities

}  // namespace

void NavierStokes::fillPhiHalo() {
  const int plane = layout_.nx * layout_.ny;
  if (!slab_.atTop())
    slab_.sendUp(phi() + static_cast<std::ptrdiff_t>(slab_.planes() - 1) * plane, plane);
  if (!slab_.atBottom()) slab_.receiveFromBelow(phi() - plane, plane);
}

/// Outer faces and ghosts of a field in the predicted axes, of a grid at `place` at the new time.
void NavierStokes::fillFarField(const Eigen::Isometry3d& place, Velocity& v) const {
  if (!known_ && !grid_.open) return;  // air at rest: what the fields were made with
  if (grid_.open) {
    fillOuter(grid_, layout_, v);
    return;
  }
  fillOuter(
      grid_, layout_,
      [&](const Eigen::Vector3d& r) -> Eigen::Vector3d {
        return predicted_.linear().transpose() * known_(place * r, (steps_ + 1) * dt_);
      },
      v);
}

/// From the place where the grid is, by its velocities of two levels.
void NavierStokes::predictPlace() {
  const GridVelocity &n = level_n_.grid, &m = level_m_.grid;
  const Eigen::Isometry3d& place = level_n_.place;
  const double old = 0.5 * length_ / levelDistance(), now = 1 + old;
  predicted_.linear() = place.linear() * expSO3(length_ * (now * n.omega - old * m.omega));
  predicted_.translation() = place.translation() + length_ * (now * place.linear() * n.V -
                                                              old * level_m_.place.linear() * m.V);
}

void NavierStokes::turnLevel(Velocity& v, Level& level) {
  const Eigen::Matrix3d Q = predicted_.linear().transpose() * level.axes;
  rotateField(layout_, team_, Q, v, v_star_);
  std::swap(v, v_star_);
  level.axes = predicted_.linear();
  level.wall = rotated(level.wall, Q);
  fillFarField(predicted_, v);  // the increment there is 0
  fillWing(grid_, layout_, level.wall, v);
  fillHalo(layout_, slab_, v);
}

void NavierStokes::convectingField(const GridVelocity& g) {
  const double extrapolation = step_.ratio;
  auto row = [&](int c, int j, int k) {
    const double z = c == 2 ? grid_.z.face[k] : grid_.z.centre[k];
    const double y = c == 1 ? grid_.y.face[j] : grid_.y.centre[j];
    const std::ptrdiff_t at = layout_.at(0, j, k);
    const double* __restrict a = vn_.c[c].data() + at;
    const double* __restrict b = vm_.c[c].data() + at;
    const double* __restrict x = (c == 0 ? grid_.x.face : grid_.x.centre).data();
    double* __restrict o = convecting_.c[c].data() + at;
    const double g0 = g.at(c, 0, y, z), gx = g.at(c, 1, y, z) - g0;
    const int n = layout_.nx + (c == 0);
#pragma omp simd
    for (int i = 0; i < n; ++i) o[i] = a[i] + extrapolation * (a[i] - b[i]) - (g0 + gx * x[i]);
  };
  const int begin = std::max(0, layout_.k0 - 1), end = std::min(layout_.k1, layout_.nz) + 1;
  team_.each(begin, end, [&](int k, int) {
    for (int c = 0; c < 3; ++c) {
      if (k > layout_.nz - (c != 2)) continue;
      for (int j = 0; j < layout_.ny + (c == 1); ++j) row(c, j, k);
    }
  });
  fillWing(grid_, layout_, WallVelocity{}, convecting_);  // no air through the wing
}

/// Largest in-plane Courant number over the wing and half a reference length above and below it.
double NavierStokes::courant() {
  team_.each(layout_.k0, layout_.k1, [&](int k, int) {
    double worst = 0;
    const bool near = std::abs(grid_.z.centre[k]) <= 0.5 * reference_length_;
    for (int j = 0; near && j < layout_.ny; ++j) {
      for (int i = 0; i < layout_.nx; ++i) {
        if (!grid_.isWing(i, j)) continue;
        const std::ptrdiff_t q = layout_.at(i, j, k);
        const double cx =
            std::max(std::abs(convecting_.c[0][q]), std::abs(convecting_.c[0][q + 1]));
        const double cy =
            std::max(std::abs(convecting_.c[1][q]), std::abs(convecting_.c[1][q + layout_.sy]));
        worst = std::max({worst, cx / grid_.x.width[i], cy / grid_.y.width[j]});
      }
    }
    rates_[k - layout_.k0] = worst;
  });
  return slab_.max(*std::max_element(rates_.begin(), rates_.end())) * length_;
}

/// What a step does before any guess of the interface: (1) predict the grid's motion, (2) turn both
/// old levels into the predicted axes (this is the Coriolis term, exactly), (3) freeze the
/// convecting field, (4) all of the momentum step that does not see the wall's new velocity.
void NavierStokes::prepareStep() {
  const GridVelocity& n = level_n_.grid;
  const GridVelocity& m = level_m_.grid;
  LapTimer timer(report_.kernel_s);
  if (!prepared_) {
    predictPlace();
    turnLevel(vn_, level_n_);
    turnLevel(vm_, level_m_);
    prepared_ = true;
  }
  step_ = {length_, length_before_, air_.mu / air_.rho, air_.rho};
  const double ahead = length_ / levelDistance();
  convectingField({n.V + ahead * (n.V - m.V), n.omega + ahead * (n.omega - m.omega)});
  report_.courant = courant();
  timer.lap(Kernel::kTurning);
  if (report_.courant > courant_limit_) {
    step_ = {};
    std::ostringstream s;
    s << "Courant number " << report_.courant << " exceeds grid/courant_limit = " << courant_limit_
      << ": use more steps a flap, a coarser grid, or raise the limit";
    throw NumericalError(s.str());
  }
  momentum_.prepare(step_, {vn_, vm_, convecting_, p_, level_n_.wall});
  timer.lap(Kernel::kMomentumXY);
}

/// Of the wing's points at the new level, by the step's own differences.
WallVelocity NavierStokes::wallAcceleration() const {
  const double r = step_.ratio, dt = step_.dt;
  return combined((1 + 2 * r) / (1 + r) / dt, next_.wall, -(1 + r) / dt, level_n_.wall,
                  r * r / (1 + r) / dt, level_m_.wall);
}

Loads NavierStokes::evaluate(const WingMotion& next) {
  if (!(dt_ > 0)) throw std::logic_error("NavierStokes::evaluate before start");
  evaluated_ = false;  // until it is done: what throws leaves nothing to commit
  if (step_.dt == 0) {
    easeIn(next);
    prepareStep();
  }
  return solve(next);
}

/// One evaluation: (1) momentum with the wall's new velocity, (2) pressure at the wing, (3) loads.
Loads NavierStokes::solve(const WingMotion& next) {
  LapTimer timer(report_.kernel_s);
  next_.axes = predicted_.linear();
  next_.grid = gridVelocity(next);
  next_.wall = wallVelocity(next_.grid);
  next_.place = placeOf(next);
  momentum_.finish(vn_, convecting_, combined(1, next_.wall, -1, level_n_.wall, 0, next_.wall),
                   v_star_);
  fillFarField(next_.place, v_star_);
  fillWing(grid_, layout_, next_.wall, v_star_);

  fillHalo(layout_, slab_, v_star_.c[2]);
  timer.lap(Kernel::kMomentumZ);

  netOutflow(grid_, layout_, team_, v_star_, air_.rho / step_.a, phi());
  timer.lap(Kernel::kOutflow);
  pressure_.solveAtWing(phi(), report_.kernel_s);
  timer.restart();

  acceleration_ = wallAcceleration();
  Loads loads;
  loads::pressureLoads(grid_, layout_, loads::WingPressure(grid_, layout_, p_.data(), phi()),
                       air_.rho, acceleration_, loads);
  loads::frictionLoads(grid_, layout_, momentum_.metrics(), v_star_, phi(), step_.a / air_.rho,
                       next_.wall, air_.mu, loads);
  loads::rimLoads(grid_, layout_, momentum_, convecting_, v_star_, air_.rho / step_.a, row_.data(),
                  loads);
  loads::sumLoads(slab_, loads);
  timer.lap(Kernel::kLoads);
  if (!loads.finite()) throw NumericalError("Navier-Stokes: the loads are not finite");
  evaluated_ = true;
  return loads;
}

void NavierStokes::commit() {
  if (!evaluated_) throw std::logic_error("NavierStokes::commit without evaluate");
  complete();
}

/// The new level in all of the air: it becomes the committed one.
void NavierStokes::complete() {
  pressure_.complete(phi(), report_.kernel_s);
  LapTimer timer(report_.kernel_s);
  fillPhiHalo();
  subtractGradient(grid_, layout_, team_, phi(), step_.a / air_.rho, v_star_);
  fillHalo(layout_, slab_, v_star_);
  team_.each(layout_.k0, layout_.k1, [&](int k, int) {
    for (int j = 0; j < layout_.ny; ++j) {
      double* p = p_.data() + layout_.at(0, j, k);
      const double* f =
          phi() + (static_cast<std::ptrdiff_t>(k - layout_.k0) * layout_.ny + j) * layout_.nx;
      for (int i = 0; i < layout_.nx; ++i) p[i] += f[i];
    }
  });
  fillHalo(layout_, slab_, p_);
  std::swap(vm_, vn_);      // n becomes n-1
  std::swap(vn_, v_star_);  // v* has become n
  level_m_ = level_n_;
  level_n_ = next_;
  committed_acceleration_ = acceleration_;
  length_before_ = length_;
  length_ = dt_;
  ++steps_;
  prepared_ = evaluated_ = false;
  step_ = {};
  if (steps_ % kDivergenceEvery == 1)
    report_.divergence = relativeDivergence(grid_, layout_, slab_, vn_);
  timer.lap(Kernel::kProjection);
}

}  // namespace monarch_flight::fluid
