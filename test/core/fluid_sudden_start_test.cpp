// A wing that is set in motion at once, at steps that cross many cells of the flow round its rim.
#include <gtest/gtest.h>

#include "core/fluid_flapping.h"
#include "fluid/momentum/stencil.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight::fluid {
namespace {

GridSettings thinCells() {
  GridSettings s = smallGrid();
  s.cells_per_chord = 14;
  s.first_cell = 0.02;
  s.far_field = 3;
  s.courant_limit = 3;
  return s;
}

/// Slides along x and turns, at an angle of attack of 45 deg.
WingMotion sliding(double t) {
  WingMotion m;
  m.R_IW = rotationY(M_PI / 4);
  m.r_I = Eigen::Vector3d(3 * t + t * t, 0, 0);
  m.v_W = m.R_IW.transpose() * Eigen::Vector3d(3 + 2 * t, 0, 0);
  m.a_W = m.R_IW.transpose() * Eigen::Vector3d(2, 0, 0);
  return m;
}

struct Start {
  std::vector<Loads> loads;  ///< of each step
  double courant = 0;        ///< largest
};

Start started(double dt, int steps) {
  Air air;
  air.rho = 1;
  air.mu = 2e-3;
  const auto flow = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), air, thinCells());
  flow->start(sliding(0), dt);
  Start start;
  for (int n = 1; n <= steps; ++n) {
    start.loads.push_back(flow->evaluate(sliding(n * dt)));
    flow->commit();
    start.courant = std::max(start.courant, flow->report().courant);
  }
  return start;
}

TEST(SuddenStart, FliesAtStepsThatCrossCellsOfTheRim) {
  const double dt = 0.016;
  const Start coarse = started(dt, 16), fine = started(dt / 4, 64);
  EXPECT_GT(coarse.courant, 1.0);  // once the parts are over
  EXPECT_LT(coarse.courant, 3.0);
  for (int n : {4, 8, 12, 16}) {
    const Eigen::Vector3d near = coarse.loads[n - 1].force(), exact = fine.loads[4 * n - 1].force();
    // The air's answer to the start changes within a step; its share fades.
    const double bound = n == 4 ? 0.03 : 0.015;
    EXPECT_LT((near - exact).norm(), bound * exact.norm()) << n << ": " << near.transpose();
  }
}

/// What a plan expects (src/run/plan.cpp): the air is at most 1.65 times as fast as the wing, also
/// behind the parts, when the vortex has grown that limits its speed round the rim.
TEST(SuddenStart, TheVortexHasGrownWhenStepsAreTakenWhole) {
  GridSettings settings = thinCells();
  settings.cells_per_chord = 24;
  const double speed = 3, cells = 1.75, dt = cells / (24 * speed);
  const auto motion = [&](double t) {
    WingMotion m;
    m.R_IW = rotationY(M_PI / 4);
    m.r_I = Eigen::Vector3d(speed * t, 0, 0);
    m.v_W = m.R_IW.transpose() * Eigen::Vector3d(speed, 0, 0);
    return m;
  };
  const auto flow = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), settings);
  flow->start(motion(0), dt);
  double most = 0;
  for (int n = 1; n <= 36; ++n) {
    flow->evaluate(motion(n * dt));
    flow->commit();
    most = std::max(most, flow->report().courant);
  }
  EXPECT_GT(most, 1.2 * cells);
  EXPECT_LT(most, 1.65 * cells);
}

/// The parts of a step belong to its first evaluation: loads are affine in the wall's velocity.
TEST(SuddenStart, LoadsOfAStepInPartsAreAffine) {
  const auto flow = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), thinCells());
  flow->start(sliding(0), 0.02);
  for (int step = 1; step <= 2; ++step) {
    const WingMotion base = sliding(0.02 * step);
    WingMotion one = base, two = base;
    one.v_W += Eigen::Vector3d(0.2, -0.1, 0.3);
    two.v_W += 2 * Eigen::Vector3d(0.2, -0.1, 0.3);
    const Eigen::Vector3d f0 = flow->evaluate(base).force(), f1 = flow->evaluate(one).force(),
                          f2 = flow->evaluate(two).force();
    EXPECT_LT((f2 - 2 * f1 + f0).norm(), 1e-10 * f2.norm());
    flow->evaluate(base);
    flow->commit();
  }
}

TEST(SuddenStart, GoesOnFromItsStateBitForBit) {
  const auto flow = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), thinCells()),
             again = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), thinCells());
  flow->start(sliding(0), 0.02);
  again->start(sliding(0), 0.02);
  flow->evaluate(sliding(0.02));
  flow->commit();
  again->restore(flow->save());
  for (int step = 2; step <= 3; ++step) {
    EXPECT_EQ(flow->evaluate(sliding(0.02 * step)).force(),
              again->evaluate(sliding(0.02 * step)).force());
    flow->commit(), again->commit();
  }
}

/// BDF2 of steps of unequal lengths: exact for a parabola.
TEST(MomentumStep, IsOfSecondOrderAfterAStepOfAnyLength) {
  for (double before : {0.1, 0.5, 1.0, 1.7}) {
    const double dt = 0.6;
    const momentum::MomentumStep step(dt, before, 1, 1);
    const auto v = [](double t) { return 2 - 3 * t + 5 * t * t; };
    EXPECT_NEAR(v(dt) - v(0), step.memory * (v(0) - v(-before)) + step.a * (10 * dt - 3), 1e-13);
  }
  const momentum::MomentumStep first(0.6, 0, 1, 1);  // implicit Euler
  EXPECT_EQ(0.0, first.memory);
  EXPECT_EQ(0.6, first.a);
}

}  // namespace
}  // namespace monarch_flight::fluid
