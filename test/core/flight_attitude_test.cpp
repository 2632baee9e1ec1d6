// A body that turns about all its axes: Newmark on the rotation group.
#include <gtest/gtest.h>

#include "core/test_insect.h"
#include "monarch_flight/flight/flight_solver.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const FreeCoordinates kSix{kX, kY, kZ, kRoll, kPitch, kYaw};

Newmark newmarkOf(double dt) {
  Newmark newmark;
  newmark.dt = dt;
  return newmark;
}

double unorthogonal(const Matrix3d& R) { return (R.transpose() * R - Matrix3d::Identity()).norm(); }

/// Level n+1 with the guess equal to the answer; joints rest, no air.
BodyState implicitStep(const FlightSolver& solver, const BodyState& n) {
  BodyState guess = n;
  for (int k = 0; k < 30; ++k) guess = solver.step(n, n, guess, {}, {});
  return guess;
}

/// A body thrown with a spin about all axes, with the accelerations that belong to it.
BodyState thrown(const FlightSolver& solver, const Vector3d& Omega,
                 const Vector3d& turned = {0.3, -0.4, 0.8}) {
  BodyState body;
  body.q_IB = expSO3(turned);
  body.Omega_B = Omega;
  body.v = {1.0, -0.3, -0.5};
  const BodyVector a = solver.accelerations(body, {}, {});
  body.a = a.head<3>();
  body.Omega_dot_B = a.tail<3>();
  setPitchAngle(body);
  return body;
}

BodyState after(const Insect& insect, double gravity, double time, int steps) {
  const FlightSolver solver(insect, gravity, kSix, newmarkOf(time / steps));
  BodyState body = thrown(solver, {9.0, 14.0, -6.0});
  for (int n = 0; n < steps; ++n) body = implicitStep(solver, body);
  return body;
}

double apart(const BodyState& a, const BodyState& b) {
  return logSO3(a.R_IB().transpose() * b.R_IB()).norm();
}

TEST(Attitude, NewmarkIsOfSecondOrderOnTheGroup) {
  const Insect insect = testing::publishedMonarch();
  const BodyState exact = after(insect, 9.81, 0.3, 4800);
  const double coarse = apart(after(insect, 9.81, 0.3, 150), exact);
  const double fine = apart(after(insect, 9.81, 0.3, 300), exact);
  EXPECT_GT(fine, 1e-9);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05);
}

TEST(Attitude, SpinKeepsEnergyAndMomentumAsTheStepGoesToZero) {
  const Insect insect = testing::publishedMonarch();
  const MultibodyDynamics dynamics(insect, 0.0);
  const auto motion = [&](const BodyState& body) { return insectMotion(insect.beta, body, {}); };
  const BodyState begin = after(insect, 0.0, 1e-9, 1);
  const double energy = dynamics.kineticEnergy(motion(begin));
  const Vector3d momentum = dynamics.linearMomentum(motion(begin));
  const Vector3d spin = dynamics.angularMomentum(motion(begin));
  double before = 0.0;
  for (int steps : {400, 800}) {
    const InsectMotion end = motion(after(insect, 0.0, 0.5, steps));
    const double error = std::abs(dynamics.kineticEnergy(end) / energy - 1.0) +
                         (dynamics.linearMomentum(end) - momentum).norm() / momentum.norm() +
                         (dynamics.angularMomentum(end) - spin).norm() / spin.norm();
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.2);
    }
    before = error;
  }
  EXPECT_LT(before, 1e-4);
}

TEST(Attitude, PurePitchStaysInItsPlaneToTheLastBit) {
  const Insect insect = testing::publishedMonarch();
  const Newmark newmark = newmarkOf(1e-3);
  const FlightSolver six(insect, 9.81, kSix, newmark);
  const FlightSolver three(insect, 9.81, FreeCoordinates{kX, kZ, kPitch}, newmark);
  BodyState a = withPitch(BodyState(), {0.2, 11.0, 0.0}), b = a;
  a.v = b.v = {1.2, 0.0, -0.4};
  for (int n = 0; n < 500; ++n) {  // it turns once and more
    a = implicitStep(six, a);
    b = implicitStep(three, b);
  }
  EXPECT_TRUE(onlyPitches(a));
  EXPECT_GT(std::abs(a.pitch.q), 2.0 * M_PI / 2.0);
  EXPECT_EQ(a.pitch.q, b.pitch.q);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.q_IB.coeffs(), b.q_IB.coeffs());
}

TEST(Attitude, FallsThroughAllAttitudesWithoutASingularity) {
  const Insect insect = testing::publishedMonarch();
  const double dt = 2e-4;
  const FlightSolver solver(insect, 9.81, kSix, newmarkOf(dt));
  const MultibodyDynamics& dynamics = solver.dynamics();
  BodyState body = thrown(solver, {5.0, 23.0, -4.0}, {0.1, 0.2, 0.0});
  const auto centre = [&] { return dynamics.massCentre(insectMotion(insect.beta, body, {})); };
  const Vector3d r0 = centre();
  const Vector3d v0 =
      dynamics.linearMomentum(insectMotion(insect.beta, body, {})) / insect.totalMass();
  double lowest = 1.0, highest = -1.0;
  constexpr int kSteps = 5000;
  for (int n = 1; n <= kSteps; ++n) {
    body = implicitStep(solver, body);
    ASSERT_TRUE(body.R_IB().allFinite() && body.Omega_B.allFinite()) << "step " << n;
    lowest = std::min(lowest, body.R_IB()(2, 0));
    highest = std::max(highest, body.R_IB()(2, 0));
  }
  EXPECT_LT(lowest, -0.9);  // nose up and nose down
  EXPECT_GT(highest, 0.9);
  EXPECT_LT(unorthogonal(body.R_IB()), 1e-14);
  const double t = kSteps * dt;
  const Vector3d parabola = r0 + t * v0 + Vector3d(0.0, 0.0, 0.5 * 9.81 * t * t);
  EXPECT_LT((centre() - parabola).norm() / parabola.norm(), 1e-5);
}

TEST(Attitude, StaysOrthogonalOverAMillionSteps) {
  const Newmark newmark = newmarkOf(1e-3);
  BodyState body;
  body.Omega_B = {20.0, -10.0, 15.0};
  for (int n = 0; n < 1000000; ++n) {
    BodyVector a = BodyVector::Zero();
    a.tail<3>() << 300.0 * std::sin(0.01 * n), 200.0 * std::cos(0.013 * n),
        -250.0 * std::sin(0.007 * n);
    body = advancedBody(body, body, kSix, newmark, a);
  }
  EXPECT_LT(unorthogonal(body.R_IB()), 1e-14);
  EXPECT_NEAR(body.R_IB().determinant(), 1.0, 1e-14);
}

/// Bit for bit, so that a symmetric flight stays the mirrored one.
TEST(Attitude, TheImageOfATurnIsTheTurnOfTheImage) {
  const Newmark newmark = newmarkOf(1e-3);
  BodyState body;
  body.q_IB = expQuaternion({0.3, -0.4, 0.8});
  body.Omega_B = {20.0, -10.0, 15.0};
  BodyState image = mirrored(body);
  for (int n = 0; n < 100; ++n) {
    BodyVector a = BodyVector::Zero(), b = a;
    a.tail<3>() << 300.0 - n, 200.0, -250.0;
    b.tail<3>() << n - 300.0, 200.0, 250.0;
    body = advancedBody(body, body, kSix, newmark, a);
    image = advancedBody(image, image, kSix, newmark, b);
    ASSERT_EQ(mirrored(body).q_IB.coeffs(), image.q_IB.coeffs()) << n;
  }
  const BodyState pitched = mirrored(withPitch(BodyState(), {0.4, 0.0, 0.0}));
  EXPECT_FALSE(std::signbit(pitched.q_IB.x()) || std::signbit(pitched.q_IB.z()));
  EXPECT_TRUE(onlyPitches(pitched));
}

/// A rig that holds the body but for its roll.
TEST(Attitude, OneTurningCoordinateAloneTurnsAboutItsAxis) {
  const Newmark newmark = newmarkOf(1e-3);
  const FreeCoordinates roll{kRoll};
  BodyState held = withPitch(BodyState(), {0.4, 0.0, 0.0}), body = held;
  BodyVector a = BodyVector::Zero();
  a(kRoll) = 50.0;
  for (int n = 0; n < 200; ++n) body = advancedBody(body, held, roll, newmark, a);
  // From rest, with the acceleration there in the second half of the first step.
  const double angle = 0.5 * 50.0 * 0.2 * 0.2 - 0.25 * 50.0 * 1e-6 - 0.5 * 50.0 * 1e-3 * 0.199;
  EXPECT_LT(logSO3((rotationY(0.4) * rotationX(angle)).transpose() * body.R_IB()).norm(), 1e-12);
}

/// Which side is which: what lifts the left wing turns the right side down.
TEST(Attitude, LiftOnTheLeftWingRollsToTheRight) {
  const FlightSolver solver(testing::publishedMonarch(), 9.81, kSix, newmarkOf(1e-3));
  Loads lift;
  lift.force_pressure = {0.0, 0.0, -1e-3};   // z points down
  lift.moment_pressure = {-2e-5, 0.0, 0.0};  // it acts 2 cm outside the root
  const BodyVector none = solver.accelerations(BodyState(), {}, {});
  const BodyVector left = solver.accelerations(BodyState(), {}, {Loads(), lift});
  const BodyVector right = solver.accelerations(BodyState(), {}, {lift, Loads()});
  EXPECT_GT((left - none)(kRoll), 0.0);
  EXPECT_LT((right - none)(kRoll), 0.0);
  EXPECT_NEAR((left - none)(kRoll), -(right - none)(kRoll), 1e-9 * std::abs(left(kRoll)));
  EXPECT_LT((left - none)(kZ), 0.0);
}

TEST(Attitude, MirroredTwiceIsTheSame) {
  BodyState body;
  body.x = {1.0, 2.0, 3.0};
  body.q_IB = expSO3({0.3, -0.4, 0.8});
  body.Omega_B = {1.0, -2.0, 3.0};
  const BodyState image = mirrored(body);
  EXPECT_EQ(image.x, Vector3d(1.0, -2.0, 3.0));
  EXPECT_EQ(image.Omega_B, Vector3d(-1.0, -2.0, -3.0));
  EXPECT_EQ(mirrored(image).q_IB.coeffs(), body.q_IB.coeffs());
  const Matrix3d mirror = Vector3d(1.0, -1.0, 1.0).asDiagonal();
  EXPECT_TRUE(image.R_IB() == mirror * body.R_IB() * mirror);
  const Vector3d angles = rollPitchYaw(body.R_IB()), turned = rollPitchYaw(image.R_IB());
  EXPECT_NEAR(turned.x(), -angles.x(), 1e-15);
  EXPECT_NEAR(turned.y(), angles.y(), 1e-15);
  EXPECT_NEAR(turned.z(), -angles.z(), 1e-15);
}

TEST(Attitude, RollPitchYawTakeApartWhatTheyMade) {
  const Vector3d angles(0.7, -0.9, 2.1);
  const Matrix3d R = rotationZ(angles.z()) * rotationY(angles.y()) * rotationX(angles.x());
  EXPECT_LT((rollPitchYaw(R) - angles).norm(), 1e-14);
}

}  // namespace
}  // namespace monarch_flight
