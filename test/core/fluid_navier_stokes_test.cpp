// Steps of the flow solver: affine in the wing's motion, repeatable bit for bit, free of
// divergence.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/fluid_flapping.h"
#include "fluid/fields/projection.h"
#include "fluid/flow/flow.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight::fluid {
namespace {

using Eigen::Vector3d;

class FlappingPlate : public ::testing::Test {
 protected:
  FlappingPlate()
      : flow_(makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid())) {
    flow_->start(flapping(0), kDt);
  }
  void advance(int steps) {
    for (int i = 0; i < steps; ++i) {
      flow_->evaluate(flapping(++step_ * kDt));
      flow_->commit();
    }
  }
  WingMotion next() const { return flapping((step_ + 1) * kDt); }

  static constexpr double kDt = 0.005;
  int step_ = 0;
  std::unique_ptr<FluidModel> flow_;
};

WingMotion moved(WingMotion m, const Vector6d& du) {
  m.v_W += du.head<3>();
  m.omega_W += du.tail<3>();
  return m;
}

TEST_F(FlappingPlate, LoadsAreAffineInTheInterfaceVelocity) {
  for (int stop : {0, 1, 12}) {  // the first step is of first order in time
    advance(stop);
    const WingMotion base = next();
    const Loads l0 = flow_->evaluate(base);
    Matrix6d K;
    for (int i = 0; i < 6; ++i) {
      const Loads l = flow_->evaluate(moved(base, Vector6d::Unit(i)));
      K.col(i) << l.force() - l0.force(), l.moment() - l0.moment();
    }
    Vector6d du;
    du << 0.3, -0.5, 0.7, -0.2, 0.4, 0.6;
    const Loads l = flow_->evaluate(moved(base, du));
    Vector6d predicted = K * du, found;
    predicted.head<3>() += l0.force();
    predicted.tail<3>() += l0.moment();
    found << l.force(), l.moment();
    EXPECT_LT((predicted - found).norm(), 1e-11 * found.norm());
    // K's normal block is the added mass times the time scheme's leading coefficient, and
    // viscosity.
    const double lead = (stop == 0 ? 1.0 : 1.5) / kDt;
    const Matrix6d M = flow_->addedMass();
    EXPECT_NEAR(-K(2, 2) / lead / M(2, 2), 1.0, 0.05);
    EXPECT_NEAR(-K(3, 3) / lead / M(3, 3), 1.0, 0.05);
    EXPECT_LT(std::abs(K(2, 3) - K(3, 2)), 0.02 * std::sqrt(K(2, 2) * K(3, 3)));
  }
}

/// Normal force and pitching moment after a fifth of a flap.
Eigen::Array2d loadsAfter(int steps) {
  const auto flow = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid());
  const double dt = 0.2 / steps;
  flow->start(flapping(0), dt);
  Loads loads;
  for (int n = 1; n <= steps; ++n) {
    loads = flow->evaluate(flapping(n * dt));
    flow->commit();
  }
  return {loads.force().z(), loads.moment().y()};
}

TEST(NavierStokes, LoadsOfAFlappingWingAreOfSecondOrderInTime) {
  const Eigen::Array2d middle = loadsAfter(100);
  const Eigen::Array2d first = loadsAfter(50) - middle, second = middle - loadsAfter(200);
  const Eigen::Array2d order = (first / second).log() / std::log(2.0);
  EXPECT_GT(order.minCoeff(), 1.7) << order.transpose();
}

TEST_F(FlappingPlate, LoadOperatorPredictsTheLoadsOfTheStep) {
  advance(3);
  LoadOperator jacobian;
  const Loads base = flow_->evaluate(next()), with = flow_->linearise(next(), jacobian);
  EXPECT_EQ(base.force(), with.force());
  EXPECT_EQ(base.moment(), with.moment());
  EXPECT_TRUE(jacobian.acceleration.isZero(0.0));
  Vector6d du, predicted, found;
  du << 0.3, -0.5, 0.7, -0.2, 0.4, 0.6;
  const Loads l = flow_->evaluate(moved(next(), du));
  predicted << base.force(), base.moment();
  predicted += jacobian.velocity * du;
  found << l.force(), l.moment();
  EXPECT_LT((predicted - found).norm(), 1e-10 * found.norm());
  // What is committed after it is the step at `next`, not one of the unit evaluations.
  const auto plain = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid());
  plain->restore(flow_->save());
  plain->evaluate(next());
  plain->commit();
  flow_->linearise(next(), jacobian);
  flow_->commit();
  EXPECT_TRUE(plain->save() == flow_->save());
}

TEST_F(FlappingPlate, AStepRestoredAHundredTimesIsTheSameStep) {
  advance(2);
  const std::vector<char> before = flow_->save();
  const Loads first = flow_->evaluate(next());
  flow_->commit();
  const std::vector<char> after = flow_->save();
  for (int i = 0; i < 100; ++i) {
    flow_->restore(before);
    if (i % 10 == 0) flow_->evaluate(moved(next(), Vector6d::Constant(0.1 * i)));
    const Loads again = flow_->evaluate(next());
    ASSERT_EQ(first.force(), again.force()) << "repetition " << i;
    ASSERT_EQ(first.moment(), again.moment());
    flow_->commit();
    ASSERT_TRUE(flow_->save() == after) << "repetition " << i;
  }
}

TEST_F(FlappingPlate, EvaluationsArePureAndStateIsRestoredBitwise) {
  advance(3);
  const WingMotion base = next();
  const Loads first = flow_->evaluate(base);
  flow_->evaluate(moved(base, Vector6d::Ones()));
  const Loads again = flow_->evaluate(base);
  EXPECT_EQ(first.force(), again.force());
  EXPECT_EQ(first.moment(), again.moment());

  const std::vector<char> prepared = flow_->save();
  flow_->commit();
  const Loads ahead = flow_->evaluate(flapping((step_ + 2) * kDt));
  flow_->restore(prepared);
  EXPECT_EQ(first.force(), flow_->evaluate(base).force());
  flow_->commit();
  const std::vector<char> committed = flow_->save();
  const auto other = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid());
  other->restore(committed);
  const Loads elsewhere = other->evaluate(flapping((step_ + 2) * kDt));
  EXPECT_EQ(ahead.force(), elsewhere.force());
  EXPECT_EQ(ahead.moment(), elsewhere.moment());
}

TEST_F(FlappingPlate, LoadsDoNotAlternateFromStepToStep) {
  std::vector<double> f;
  for (int i = 0; i < 100; ++i) {
    const Loads l = flow_->evaluate(next());
    advance(1);
    f.push_back(l.force().z());
  }
  double rms = 0, noise = 0;
  for (std::size_t i = 20; i + 4 < f.size(); ++i) {
    rms += f[i] * f[i];
    const double d4 = (f[i] - 4 * f[i + 1] + 6 * f[i + 2] - 4 * f[i + 3] + f[i + 4]) / 16;
    noise += d4 * d4;
  }
  EXPECT_LT(std::sqrt(noise / rms), 1e-4);
}

TEST_F(FlappingPlate, VelocityIsFreeOfDivergenceAndMeetsTheWall) {
  auto& flow = dynamic_cast<NavierStokes&>(*flow_);
  advance(5);
  EXPECT_LT(relativeDivergence(flow.grid(), flow.layout(), flow.velocity()), 1e-11);
  EXPECT_GT(flow.report().divergence, 0);  // of rounding: it was taken
  EXPECT_LT(flow.report().divergence, 1e-11);
  const WingMotion now = flapping(step_ * kDt);
  const Grid& g = flow.grid();
  for (int j = 0; j < g.y.n(); ++j)
    for (int i = 0; i < g.x.n(); ++i) {
      if (!g.isWing(i, j)) continue;
      const Vector3d wall = now.v_W + now.omega_W.cross(Vector3d(g.x.centre[i], g.y.centre[j], 0));
      ASSERT_NEAR(flow.velocity().c[2][flow.layout().at(i, j, g.k_wing)], wall.z(), 1e-13);
    }
}

TEST_F(FlappingPlate, BadStepsEndWithAReason) {
  EXPECT_THROW(flow_->commit(), std::logic_error);
  WingMotion bad = next();
  bad.v_W.x() = std::nan("");
  EXPECT_THROW(flow_->evaluate(bad), NumericalError);
  std::vector<char> state = flow_->save();
  state.pop_back();
  EXPECT_THROW(flow_->restore(state), std::invalid_argument);
}

TEST_F(FlappingPlate, NothingIsLeftToCommitAfterAnEvaluationThatThrew) {
  advance(2);
  const std::vector<char> committed = flow_->save();
  WingMotion bad = next();
  bad.v_W.x() = std::nan("");
  const Loads good = flow_->evaluate(next());
  EXPECT_THROW(flow_->evaluate(bad), NumericalError);
  EXPECT_THROW(flow_->commit(), std::logic_error);
  EXPECT_EQ(flow_->evaluate(next()).force(), good.force());
  EXPECT_NO_THROW(flow_->commit());
  flow_->restore(committed);
  EXPECT_EQ(flow_->evaluate(next()).force(), good.force());
}

void expectSamePicture(const SurfacePressure& a, const SurfacePressure& b, const char* when) {
  ASSERT_EQ(a.facets.size(), b.facets.size());
  for (std::size_t i = 0; i < a.facets.size(); ++i) {
    ASSERT_EQ(a.facets[i].p_upper, b.facets[i].p_upper) << when;
    ASSERT_EQ(a.facets[i].p_lower, b.facets[i].p_lower) << when;
  }
}

double normalForce(const SurfacePressure& surface) {
  double force = 0.0;
  for (const auto& f : surface.facets) force += double(f.p_upper - f.p_lower) * f.dx * f.dy;
  return force;
}

TEST_F(FlappingPlate, PicturesAreThoseOfTheCommittedLevel) {
  advance(3);
  const Loads loads = flow_->evaluate(next());
  advance(1);
  const SurfacePressure committed = flow_->surfacePressure();
  EXPECT_NEAR(normalForce(committed), loads.force_pressure.z(),
              1e-5 * std::abs(loads.force_pressure.z()));
  const std::vector<std::int16_t> vortices = flow_->flowPicture(2000).q_root;
  EXPECT_GT(*std::max_element(vortices.begin(), vortices.end()), 0);
  const std::vector<char> state = flow_->save();

  flow_->evaluate(moved(next(), Vector6d::Ones()));
  expectSamePicture(flow_->surfacePressure(), committed, "after evaluate");
  EXPECT_THROW(flow_->flowPicture(2000), std::logic_error);
  EXPECT_THROW(flow_->flowField(), std::logic_error);
  const std::vector<char> between = flow_->save();
  advance(1);
  EXPECT_NE(normalForce(flow_->surfacePressure()), normalForce(committed));

  const auto other = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid());
  for (FluidModel* model : {flow_.get(), other.get()}) {
    model->restore(state);
    expectSamePicture(model->surfacePressure(), committed, "after restore");
    EXPECT_EQ(model->flowPicture(2000).q_root, vortices);
    model->restore(between);
    expectSamePicture(model->surfacePressure(), committed, "after restore of a step begun");
    EXPECT_THROW(model->flowPicture(2000), std::logic_error);
  }
  flow_->start(flapping(0), kDt);
  EXPECT_EQ(normalForce(flow_->surfacePressure()), 0.0);
  EXPECT_NO_THROW(flow_->flowPicture(2000));
}

TEST(NavierStokes, AFlowThatWasNotStartedCannotGoOn) {
  const auto flow = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid());
  EXPECT_THROW(flow->evaluate(flapping(0)), std::logic_error);
  EXPECT_THROW(flow->commit(), std::logic_error);
}

TEST(NavierStokes, ACourantNumberAboveTheLimitEndsTheRun) {
  GridSettings s = smallGrid();
  s.courant_limit = 0.01;
  const auto flow = makeNavierStokes(Planform::rectangle(1, 2, 0.5), thinAir(), s);
  flow->start(flapping(0.1), 0.01);
  try {
    flow->evaluate(flapping(0.11));
    flow->commit();
    flow->evaluate(flapping(0.12));
    FAIL() << "no error";
  } catch (const NumericalError& e) {
    EXPECT_NE(std::string(e.what()).find("courant_limit"), std::string::npos);
  }
}

}  // namespace
}  // namespace monarch_flight::fluid
