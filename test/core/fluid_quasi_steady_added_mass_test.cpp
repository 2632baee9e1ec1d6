// Added mass of the blade-element model: exact integrals, and the energy of the air.
#include <gtest/gtest.h>

#include "core/quasi_steady_motions.h"

namespace monarch_flight {
namespace {

constexpr double kPi = 3.14159265358979323846;

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

}  // namespace
}  // namespace monarch_flight
