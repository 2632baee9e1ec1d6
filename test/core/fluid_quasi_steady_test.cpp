// Blade-element model against the laws of docs/quasi_steady.md: translation and rotation.
#include <gtest/gtest.h>

#include "core/quasi_steady_motions.h"
#include "monarch_flight/insect/prescribed_motion.h"

namespace monarch_flight {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

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
  const Wind wind{Vector3d(1.2, -0.4, 0.7), Vector3d(20.0, 3.0, -8.0)};  // which rises
  const auto model = makeQuasiSteady(Planform::ellipse(0.03, 0.06, 0.3), air(), kSane);
  WingMotion m;
  m.R_IW = expSO3(Vector3d(0.3, -0.8, 0.2));
  m.v_W = m.R_IW.transpose() * wind.v;
  m.a_W = m.R_IW.transpose() * wind.a;
  EXPECT_EQ(wrench(loadsOf(*model, relativeTo(wind, m))).norm(), 0.0);
  m.v_W.setZero();  // held in the wind: as if flown against it in still air
  m.a_W.setZero();
  WingMotion flown = m;
  flown.v_W = -(m.R_IW.transpose() * wind.v);
  flown.a_W = -(m.R_IW.transpose() * wind.a);
  const Vector6d w = wrench(loadsOf(*model, relativeTo(wind, m)));
  EXPECT_GT(w.norm(), 0.0);
  EXPECT_LT((w - wrench(loadsOf(*model, flown))).norm(), 1e-14 * w.norm());
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

}  // namespace
}  // namespace monarch_flight
