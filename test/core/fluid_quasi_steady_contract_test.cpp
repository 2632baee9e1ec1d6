// Blade-element model by the contract of every FluidModel.
#include <gtest/gtest.h>

#include <limits>

#include "core/quasi_steady_motions.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

TEST(QuasiSteadyContract, EvaluationIsAPureFunctionAndStateRestores) {
  std::mt19937 generator(2);
  const auto model = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), kSane);
  model->start(WingMotion{}, 1e-3);
  const WingMotion a = randomMotion(generator), b = randomMotion(generator);
  const Vector6d first = wrench(model->evaluate(a));
  model->evaluate(b);
  EXPECT_EQ(first, wrench(model->evaluate(a)));
  model->commit();
  const auto saved = model->save();
  const SurfacePressure before = model->surfacePressure();
  model->evaluate(b);
  model->commit();
  model->restore(saved);
  const SurfacePressure after = model->surfacePressure();
  ASSERT_EQ(before.facets.size(), after.facets.size());
  for (std::size_t i = 0; i < before.facets.size(); ++i)
    EXPECT_EQ(before.facets[i].p_upper, after.facets[i].p_upper);
  EXPECT_THROW(model->restore(std::vector<char>(3)), std::invalid_argument);
  EXPECT_EQ(model->cells(), 0);
  EXPECT_EQ(model->report().courant, 0.0);
  EXPECT_TRUE(model->flowPicture(1000).empty());
}

TEST(QuasiSteadyContract, PicturesAreThoseOfTheCommittedLevel) {
  const auto model = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), kSane);
  const auto pressure = [](const FluidModel& one) {
    std::vector<float> all;
    for (const auto& f : one.surfacePressure().facets) all.push_back(f.p_upper);
    return all;
  };
  EXPECT_THROW(model->evaluate(translation(1.0, 0.3)), std::logic_error);  // not started
  EXPECT_THROW(model->commit(), std::logic_error);
  model->start(WingMotion{}, 1e-3);
  model->evaluate(translation(1.0, 0.3));
  model->commit();
  const std::vector<float> committed = pressure(*model);
  const std::vector<char> state = model->save();
  model->evaluate(translation(2.0, 0.5));
  EXPECT_EQ(pressure(*model), committed);
  WingMotion bad = translation(1.0, 0.3);
  bad.v_W.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(model->evaluate(bad), NumericalError);
  EXPECT_EQ(pressure(*model), committed);
  model->evaluate(translation(2.0, 0.5));
  model->commit();
  EXPECT_NE(pressure(*model), committed);
  const auto other = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), kSane);
  for (FluidModel* one : {model.get(), other.get()}) {
    one->restore(state);
    EXPECT_EQ(pressure(*one), committed);
    EXPECT_THROW(one->commit(), std::logic_error);
  }
}

TEST(QuasiSteadyContract, LoadOperatorIsTheJacobianOfTheLoads) {
  std::mt19937 generator(23);
  for (auto variant : {kSane, kWhitney}) {
    const auto model = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), variant);
    const WingMotion m = randomMotion(generator);
    const Vector6d base = wrench(loadsOf(*model, m));
    LoadOperator jacobian;
    EXPECT_EQ(wrench(model->linearise(m, jacobian)), base);
    EXPECT_EQ(jacobian.acceleration, Matrix6d(-model->addedMass()));
    Vector6d du, da;
    du << 1e-3, -2e-3, 3e-3, 0.1, -0.2, 0.15;
    da << 10.0, -20.0, 5.0, 300.0, 100.0, -200.0;
    WingMotion moved = m;
    moved.v_W += du.head<3>();
    moved.omega_W += du.tail<3>();
    moved.a_W += da.head<3>();
    moved.alpha_W += da.tail<3>();
    const Vector6d change = wrench(model->evaluate(moved)) - base;
    const Vector6d predicted = jacobian.velocity * du + jacobian.acceleration * da;
    EXPECT_LT((change - predicted).norm(), 3e-3 * change.norm());
  }
}

TEST(QuasiSteadyContract, SurfacePressureCarriesTheNormalForce) {
  const Planform plan = Planform::rectangle(0.02, 0.05, 0.3);
  const auto model = makeQuasiSteady(plan, air(), kSane);
  std::mt19937 generator(9);
  model->start(WingMotion{}, 1e-3);
  const Loads loads = model->evaluate(randomMotion(generator));
  model->commit();
  const SurfacePressure surface = model->surfacePressure();
  EXPECT_GE(surface.facets.size(), 50u);
  double area = 0.0, force = 0.0, y = 0.0;
  for (const auto& f : surface.facets) {
    EXPECT_NEAR(f.y - 0.5 * f.dy, y, 1e-7);  // the strips tile the span
    y = f.y + 0.5 * f.dy;
    area += double(f.dx) * f.dy;
    force += (double(f.p_upper) - f.p_lower) * f.dx * f.dy;
  }
  EXPECT_NEAR(area, plan.area(), 1e-6 * plan.area());
  EXPECT_NEAR(force, loads.force().z(), 1e-5 * std::abs(loads.force().z()));
}

TEST(QuasiSteadyContract, NonFiniteMotionIsANumericalError) {
  const auto model = makeQuasiSteady(Planform::rectangle(0.02, 0.05, 0.3), air(), kSane);
  model->start(WingMotion{}, 1e-3);
  WingMotion m = translation(1.0, 0.3);
  m.a_W.z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(model->evaluate(m), NumericalError);
  m = translation(1.0, 0.3);
  m.omega_W.y() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(model->evaluate(m), NumericalError);
  m = translation(1.0, 0.3);
  m.v_W.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(model->evaluate(m), NumericalError);
}

TEST(QuasiSteadyContract, NothingIsLeftToCommitAfterAnEvaluationThatThrew) {
  const auto model = makeQuasiSteady(Planform::rectangle(0.02, 0.05, 0.3), air(), kSane);
  model->start(WingMotion{}, 1e-3);
  const WingMotion good = translation(1.0, 0.3);
  WingMotion bad = good;
  bad.a_W.z() = std::numeric_limits<double>::quiet_NaN();
  const auto committed = model->save();
  model->evaluate(good);
  EXPECT_THROW(model->evaluate(bad), NumericalError);
  EXPECT_THROW(model->commit(), std::logic_error);
  model->evaluate(good);
  LoadOperator jacobian;
  EXPECT_THROW(model->linearise(bad, jacobian), NumericalError);
  EXPECT_THROW(model->commit(), std::logic_error);
  EXPECT_EQ(model->save(), committed);
  model->evaluate(good);
  EXPECT_NO_THROW(model->commit());
}

}  // namespace
}  // namespace monarch_flight
