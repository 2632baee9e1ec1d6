// Blade-element model against the laws of docs/quasi_steady.md.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fluid/quasi_steady/coefficients.h"
#include "fluid/quasi_steady/strips.h"
#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr auto kSane = BladeElementVariant::kSaneDickinson;
constexpr auto kWhitney = BladeElementVariant::kWhitneyWood;

Air air() { return Air{}; }
double rho() { return air().rho; }

Loads loadsOf(FluidModel& model, const WingMotion& motion) {
  model.start(WingMotion{}, 1e-3);
  return model.evaluate(motion);
}

Vector6d wrench(const Loads& loads) {
  Vector6d w;
  w << loads.force(), loads.moment();
  return w;
}

// A wing that moves with constant velocity in its own plane x-z, `alpha` ventral of forward.
WingMotion translation(double speed, double alpha) {
  WingMotion m;
  m.v_W = Vector3d(speed * std::cos(alpha), 0.0, speed * std::sin(alpha));
  return m;
}

WingMotion randomMotion(std::mt19937& generator) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto vector = [&](double scale) {
    return Vector3d(scale * Vector3d(u(generator), u(generator), u(generator)));
  };
  WingMotion m;
  m.R_IW = expSO3(vector(2.0));
  m.v_W = vector(3.0);
  m.omega_W = vector(60.0);
  m.a_W = vector(200.0);
  m.alpha_W = vector(5e3);
  return m;
}

TEST(QuasiSteadyAddedMass, RectangleIsTheExactIntegral) {
  const double c = 0.02, b = 0.05, y0 = 0.004, hinge = 0.25;
  const auto model = makeQuasiSteady(Planform::rectangle(c, b, hinge, y0), air(), kSane);
  const Matrix6d M = model->addedMass();
  const double m = 0.25 * kPi * rho() * c * c, y1 = y0 + b, xm = (hinge - 0.5) * c;
  const double I1 = 0.5 * (y1 * y1 - y0 * y0), I2 = (y1 * y1 * y1 - y0 * y0 * y0) / 3.0;
  Matrix6d exact = Matrix6d::Zero();
  exact(2, 2) = m * b;
  exact(3, 3) = m * I2;
  exact(4, 4) = m * xm * xm * b + kPi / 128.0 * rho() * std::pow(c, 4) * b;
  exact(2, 3) = exact(3, 2) = m * I1;
  exact(2, 4) = exact(4, 2) = -m * xm * b;
  exact(3, 4) = exact(4, 3) = -m * xm * I1;
  EXPECT_LT((M - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
}

TEST(QuasiSteadyAddedMass, EllipseIsTheExactIntegral) {
  const double c = 0.03, b = 0.06;  // full axes, root end at y = 0, hinge through mid-chord
  const Matrix6d M = makeQuasiSteady(Planform::ellipse(c, b, 0.5), air(), kSane)->addedMass();
  const double heave = 0.25 * kPi * rho() * c * c * (2.0 / 3.0) * b;
  EXPECT_NEAR(M(2, 2), heave, 1e-10 * heave);
  EXPECT_NEAR(M(2, 3), heave * 0.5 * b, 1e-10 * heave * b);
  // integral of (1 - s^2) s^2 ds over [-1, 1] = 4/15, half span h: h^3 4/15, and the centre's
  // offset
  const double h = 0.5 * b;
  const double roll = 0.25 * kPi * rho() * c * c * std::pow(h, 3) * 4.0 / 15.0 + heave * h * h;
  EXPECT_NEAR(M(3, 3), roll, 1e-10 * roll);
  // integral of (1 - s^2)^2 ds = 16/15
  const double pitch = kPi / 128.0 * rho() * std::pow(c, 4) * h * 16.0 / 15.0;
  EXPECT_NEAR(M(4, 4), pitch, 1e-9 * pitch);
}

TEST(QuasiSteadyAddedMass, IsSymmetricPositiveSemidefinite) {
  const Planform plan =
      Planform::table({0.0, 0.02, 0.05}, {0.012, 0.02, 0.001}, {-0.02, -0.03, -0.004});
  const Matrix6d M = makeQuasiSteady(plan, air(), kWhitney)->addedMass();
  EXPECT_EQ((M - M.transpose()).cwiseAbs().maxCoeff(), 0.0);
  const Vector6d eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix6d>(M).eigenvalues();
  EXPECT_GT(eigenvalues[0], -1e-15 * eigenvalues[5]);
  EXPECT_EQ(M.row(0).cwiseAbs().sum() + M.row(1).cwiseAbs().sum() + M.row(5).cwiseAbs().sum(), 0.0);
}

TEST(QuasiSteadyAddedMass, LoadsAreAffineInTheAccelerations) {
  std::mt19937 generator(7);
  const auto model = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), kSane);
  const Matrix6d M = model->addedMass();
  for (int i = 0; i < 20; ++i) {
    WingMotion m = randomMotion(generator);
    const Vector6d with = wrench(loadsOf(*model, m));
    Vector6d acceleration;
    acceleration << m.a_W, m.alpha_W;
    m.a_W.setZero();
    m.alpha_W.setZero();
    const Vector6d without = wrench(loadsOf(*model, m));
    EXPECT_LT((with - without + M * acceleration).norm(), 1e-12 * with.norm());
  }
}

TEST(QuasiSteadyTranslation, ForcesAreThePublishedCoefficients) {
  const double c = 0.02, b = 0.05, U = 2.3, q = 0.5 * rho() * U * U * c * b;
  for (auto variant : {kSane, kWhitney}) {
    const auto model = makeQuasiSteady(Planform::rectangle(c, b, 0.3), air(), variant);
    for (double degrees : {7.0, 20.0, 45.0, 60.0, 84.0}) {
      const double a = degrees * kDegree;
      const bool sane = variant == kSane;
      const double cl = sane ? 0.225 + 1.58 * std::sin((2.13 * degrees - 7.2) * kDegree)
                             : 1.8 * std::sin(2.0 * a);
      const double cd = sane ? 1.92 - 1.55 * std::cos((2.04 * degrees - 9.82) * kDegree)
                             : 1.9 - 1.5 * std::cos(2.0 * a);
      const double xcp = (sane ? 0.90 : 0.82) * a / kPi + 0.05;
      const Loads loads = loadsOf(*model, translation(U, a));
      const Vector3d F = loads.force_pressure;
      const Vector3d ahead(std::cos(a), 0.0, std::sin(a)), up(std::sin(a), 0.0, -std::cos(a));
      EXPECT_NEAR(F.dot(up), q * cl, 1e-12 * q);
      EXPECT_NEAR(-F.dot(ahead), q * cd, 1e-12 * q);
      EXPECT_EQ(F.y(), 0.0);
      const Vector3d at((0.3 - xcp) * c, 0.5 * b, 0.0);
      EXPECT_LT((loads.moment_pressure - at.cross(F)).norm(), 1e-12 * q * b);
      EXPECT_EQ(loads.force_friction.norm() + loads.moment_friction.norm(), 0.0);
    }
  }
}

TEST(QuasiSteadyTranslation, UpsideDownIsTheMirrorImage) {
  const auto model = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), kSane);
  for (double degrees : {3.0, 40.0, 88.0, 120.0, 177.0}) {
    const Loads up = loadsOf(*model, translation(1.7, degrees * kDegree));
    const Loads down = loadsOf(*model, translation(1.7, -degrees * kDegree));
    EXPECT_DOUBLE_EQ(up.force().x(), down.force().x());
    EXPECT_DOUBLE_EQ(up.force().z(), -down.force().z());
    EXPECT_DOUBLE_EQ(up.moment().y(), -down.moment().y());
  }
}

// A flat plate does not know its leading from its trailing edge: chordwise reflection of wing and
// motion.
TEST(QuasiSteadyTranslation, ReversedFlowIsTheReflectionAcrossTheSpan) {
  const auto forward = makeQuasiSteady(Planform::rectangle(0.02, 0.05, 0.3), air(), kSane);
  const auto reversed = makeQuasiSteady(Planform::rectangle(0.02, 0.05, 0.7), air(), kSane);
  std::mt19937 generator(3);
  for (int i = 0; i < 20; ++i) {
    WingMotion m = randomMotion(generator);
    m.R_IW.setIdentity();
    WingMotion r =
        m;  // reflected across the plane x = 0: polar vectors flip x, axial ones flip y and z
    r.v_W.x() *= -1.0;
    r.a_W.x() *= -1.0;
    r.omega_W.tail<2>() *= -1.0;
    r.alpha_W.tail<2>() *= -1.0;
    const Loads a = loadsOf(*forward, m);
    Loads b = loadsOf(*reversed, r);
    b.force_pressure.x() *= -1.0;
    b.moment_pressure.tail<2>() *= -1.0;
    EXPECT_LT((wrench(a) - wrench(b)).norm(), 1e-12 * wrench(a).norm());
  }
}

TEST(QuasiSteadyTranslation, LoadsHaveNoStepAnywhereOnTheCircle) {
  for (auto variant : {kSane, kWhitney}) {
    const auto model = makeQuasiSteady(Planform::rectangle(0.02, 0.05, 0.3), air(), variant);
    const double q = 0.5 * rho() * 0.02 * 0.05, step = 1e-6;
    for (double a = -kPi; a < kPi; a += 0.25 * kDegree) {
      const Vector6d d = wrench(loadsOf(*model, translation(1.0, a + step))) -
                         wrench(loadsOf(*model, translation(1.0, a - step)));
      EXPECT_LT(d.head<3>().norm(), 10.0 * q * 2.0 * step) << "alpha " << a;
    }
  }
}

TEST(QuasiSteadyTranslation, NothingOnAWingThatMovesWithTheWind) {
  Air windy = air();
  windy.wind_I = Vector3d(1.2, -0.4, 0.7);
  const auto model = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), windy, kSane);
  WingMotion m;
  m.R_IW = expSO3(Vector3d(0.3, -0.8, 0.2));
  m.v_W = m.R_IW.transpose() * windy.wind_I;
  EXPECT_EQ(wrench(loadsOf(*model, m)).norm(), 0.0);
  m.v_W.setZero();  // at rest in the wind: as if flown against it in still air
  const auto still = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), kSane);
  WingMotion flown = m;
  flown.v_W = -(m.R_IW.transpose() * windy.wind_I);
  const Vector6d w = wrench(loadsOf(*model, m));
  EXPECT_GT(w.norm(), 0.0);
  EXPECT_LT((w - wrench(loadsOf(*still, flown))).norm(), 1e-14 * w.norm());
}

TEST(QuasiSteadyRotation, DampingOfPureRotationIsTheStatedIntegralAndDissipates) {
  const double c = 0.02, b = 0.05, hinge = 0.3, ahead = hinge * c, behind = (1.0 - hinge) * c;
  for (auto variant : {kSane, kWhitney}) {
    const auto model = makeQuasiSteady(Planform::rectangle(c, b, hinge), air(), variant);
    for (double omega : {-80.0, 80.0}) {
      WingMotion m;
      m.omega_W = Vector3d(0.0, omega, 0.0);
      const Loads loads = loadsOf(*model, m);
      const double integral = 0.25 * b * (std::pow(ahead, 4) + std::pow(behind, 4));
      const double crd =
          variant == kSane ? 1.92 - 1.55 * std::cos((2.04 * 90.0 - 9.82) * kDegree) : 5.0;
      const double expected = -0.5 * rho() * crd * std::abs(omega) * omega * integral;
      EXPECT_NEAR(loads.moment().y(), expected, 1e-12 * std::abs(expected));
      EXPECT_LT(loads.moment().y() * omega, 0.0);
      EXPECT_EQ(loads.force().norm(), 0.0);
    }
  }
}

// Rotational circulation: twice the pitch rate, damping excluded by its evenness in the sign of
// u_x.
TEST(QuasiSteadyRotation, CirculationIsSaneAndDickinsons) {
  const double c = 0.02, b = 0.05, x0 = 0.3, U = 2.0, omega = 30.0;
  const auto model = makeQuasiSteady(Planform::rectangle(c, b, x0), air(), kSane);
  WingMotion still = translation(U, 0.0), turning = still;
  turning.omega_W.y() = omega;
  turning.a_W = turning.omega_W.cross(turning.v_W);  // no added-mass load: du/dt = 0 in wing axes
  const Vector3d dF = loadsOf(*model, turning).force() - loadsOf(*model, still).force();
  const double expected = -kPi * (0.75 - x0) * rho() * U * omega * c * c * b;
  EXPECT_NEAR(dF.z(), expected, 1e-12 * std::abs(expected));
  EXPECT_NEAR(dF.x(), 0.0, 1e-15);
}

TEST(QuasiSteadyRotation, TranslationAndDampingTakeEnergyFromTheWing) {
  std::mt19937 generator(11);
  const auto model = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), kWhitney);
  for (int i = 0; i < 50; ++i) {  // pure flapping about x and pure pitching: drag only
    WingMotion m = randomMotion(generator);
    m.v_W.setZero();
    m.omega_W = i % 2 ? Vector3d(m.omega_W.x(), 0, 0) : Vector3d(0, m.omega_W.y(), 0);
    m.a_W.setZero();
    m.alpha_W.setZero();
    const Loads loads = loadsOf(*model, m);
    EXPECT_LT(loads.moment().dot(m.omega_W), 0.0);
  }
}

// The steady and rotational loads depend on velocities alone and drop out of the difference to a
// motion with equal velocities that is constant in wing axes; what is left is the added mass.
TEST(QuasiSteadyAddedMass, PowerIsTheRateOfTheAirsKineticEnergy) {
  std::mt19937 generator(5);
  const auto model = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), kSane);
  const Matrix6d M = model->addedMass();
  for (int i = 0; i < 20; ++i) {
    const WingMotion m = randomMotion(generator);
    // The same velocities, but the state of motion constant in wing axes: no kinetic energy is
    // exchanged.
    WingMotion steady = m;
    steady.a_W = m.omega_W.cross(m.v_W);
    steady.alpha_W.setZero();
    Vector6d w;
    w << m.v_W, m.omega_W;
    const double power = (wrench(loadsOf(*model, m)) - wrench(loadsOf(*model, steady))).dot(w);
    // dT/dt by central differences along the motion: v_W' = a_W - omega x v_W
    const double h = 1e-7;
    Vector6d rate;
    rate << m.a_W - m.omega_W.cross(m.v_W), m.alpha_W;
    const Vector6d after = w + h * rate, before = w - h * rate;
    const double dT = (after.dot(M * after) - before.dot(M * before)) / (4.0 * h);
    EXPECT_NEAR(power, -dT, 1e-7 * (std::abs(dT) + rate.norm() * (M * w).norm()));
  }
}

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
  EXPECT_TRUE(model->vortices(0.0, 10).empty());
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

}  // namespace
}  // namespace monarch_flight
