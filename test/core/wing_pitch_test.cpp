#include <gtest/gtest.h>

#include "core/test_insect.h"
#include "monarch_flight/wing/wing_pitch_solver.h"

namespace monarch_flight {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::both;
using testing::Random;

constexpr double kGravity = 9.81;

/// The printed equation (model.md section 3) for a body that only pitches: theta''.
double printedEquation(const Insect& insect, const BodyState& body, const JointAngles& angles,
                       const Loads& loads) {
  const Appendage& wing = insect.wings.right.plate;
  const WingAngles& own = angles.wings.right;
  const auto& [phi, psi, theta] = own;
  const double w = body.pitch.qd, w_dot = body.pitch.qdd;
  const double cp = std::cos(psi.q), sp = std::sin(psi.q);
  const double ct = std::cos(theta.q), st = std::sin(theta.q);
  const Vector3d e2 = Vector3d::UnitY(), e3 = Vector3d::UnitZ();
  const Matrix3d Q_t = wingAttitude(Side::kRight, insect.beta, own).transpose();
  const Vector3d rate = wingRate(own), n = Q_t * e2, W = rate + w * n;
  const Vector3d& mu = wing.mu;
  const Vector3d a = Q_t * (body.R_IB().transpose() * (body.a - kGravity * e3) +
                            w_dot * e2.cross(mu) + w * w * e2.cross(e2.cross(mu)));
  const double W_x_dot = phi.qdd * cp * ct - phi.qd * psi.qd * sp * ct -
                         phi.qd * theta.qd * cp * st + psi.qdd * st + psi.qd * theta.qd * ct +
                         w_dot * n.x() - w * rate.cross(n).x();
  const double J_yy = wing.J(1, 1), J_xy = wing.J(0, 1);  // J_xy = - integral x y dm
  const double spring = -insect.wings.right.kappa * (theta.q - insect.wings.right.theta_0);
  const double moment = loads.moment().y() + spring + wing.m * wing.nu.x() * a.z() -
                        J_yy * (phi.qdd * sp + phi.qd * psi.qd * cp + w_dot * n.y() -
                                w * rate.cross(n).y() - W.x() * W.z()) -
                        J_xy * (W_x_dot + W.y() * W.z());
  return moment / J_yy;
}

TEST(WingPitch, EqualsThePrintedEquation) {
  const Insect insect = testing::largeMonarch();
  const WingPitchSolver solver(Side::kRight, insect, kGravity, Newmark());
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    const BodyState body = random.pitchedBody();
    const JointAngles angles = random.angles();
    const Loads loads = random.loads();
    const double expected = printedEquation(insect, body, angles, loads);
    EXPECT_NEAR(solver.acceleration(body, angles, loads), expected,
                1e-12 * std::max(1.0, std::abs(expected)));
  }
}

/// Rows of the hinges in the system of all 15 velocities, for any motion of body and wings.
TEST(WingPitch, EqualsTheFullSystem) {
  const Insect insect = testing::largeMonarch();
  const PerWing<WingPitchSolver> solvers{{Side::kRight, insect, kGravity, Newmark()},
                                         {Side::kLeft, insect, kGravity, Newmark()}};
  const MultibodyDynamics dynamics(insect, kGravity);
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    const BodyState body = random.body();
    JointAngles angles = random.angles();
    angles.wings.left = random.angles().wings.left;
    PerWing<Loads> loads = both(random.loads());
    loads.left = random.loads();
    for (Side side : kSides) {
      Coordinate& theta = angles.wings[side].theta;
      theta.qdd = solvers[side].acceleration(body, angles, loads[side]);
    }
    const InsectMotion motion = insectMotion(insect.beta, body, angles);
    const auto torques = dynamics.jointTorques(motion, loads);
    for (Side side : kSides) {
      const Wing& wing = insect.wings[side];
      const double spring = -wing.kappa * (angles.wings[side].theta.q - wing.theta_0);
      EXPECT_NEAR(torques[side == Side::kRight ? 0 : 1].y(), spring,
                  1e-12 * dynamics.inertialForce(motion).tail<9>().norm());
    }
  }
}

/// For a symmetric motion the left hinge obeys the same equation.
TEST(WingPitch, HoldsForTheLeftWingOfASymmetricMotion) {
  const Insect insect = testing::largeMonarch();
  const MultibodyDynamics dynamics(insect, kGravity);
  Random random(13);
  for (int i = 0; i < 50; ++i) {
    BodyState body = random.pitchedBody();
    body.v.y() = body.a.y() = 0.0;
    const auto torque = dynamics.jointTorques(insectMotion(insect.beta, body, random.angles()),
                                              both(random.loads()));
    EXPECT_NEAR(torque[0].y(), torque[1].y(), 1e-13 * torque[0].norm());
  }
}

/// A wing with its hinge line vertical, no air: theta'' = -kappa/J_yy (theta - theta_0).
class Pendulum : public ::testing::Test {
 protected:
  Pendulum() : insect_(testing::largeMonarch()) {
    insect_.bare_wing = true;
    insect_.beta = 0.0;
    for (Side side : kSides) insect_.wings[side].theta_0 = 0.3;
    body_.q_IB = quaternionX(0.5 * M_PI);  // y of the wing points along z of NED: no weight
  }
  const Wing& wing() const { return insect_.wings.right; }
  double period() const { return 2.0 * M_PI * std::sqrt(wing().plate.J(1, 1) / wing().kappa); }
  /// Amplitude error after one period with `steps` steps.
  double error(int steps) const {
    Newmark newmark;
    newmark.dt = period() / steps;
    const WingPitchSolver solver(Side::kRight, insect_, kGravity, newmark);
    JointAngles angles;
    Coordinate& theta = angles.wings.right.theta;
    theta.q = wing().theta_0 + 0.2;
    theta.qdd = solver.acceleration(body_, angles, Loads());
    for (int i = 0; i < steps; ++i) theta = solver.step(theta, body_, angles, Loads());
    return std::hypot(theta.q - wing().theta_0 - 0.2, theta.qd * period() / (2.0 * M_PI));
  }
  Insect insect_;
  BodyState body_;
};

TEST_F(Pendulum, HasTheExactPeriodWithSecondOrder) {
  const double coarse = error(100), fine = error(200), finest = error(400);
  EXPECT_LT(finest, 1e-3 * 0.2);
  EXPECT_NEAR(coarse / fine, 4.0, 0.02);
  EXPECT_NEAR(fine / finest, 4.0, 0.02);
}

TEST_F(Pendulum, AverageAccelerationKeepsTheEnergy) {
  Newmark newmark;
  newmark.dt = period() / 20;
  const WingPitchSolver solver(Side::kRight, insect_, kGravity, newmark);
  JointAngles angles;
  Coordinate& theta = angles.wings.right.theta;
  theta.q = wing().theta_0 + 0.2;
  theta.qdd = solver.acceleration(body_, angles, Loads());
  auto energy = [&] {
    return wing().plate.J(1, 1) * theta.qd * theta.qd +
           wing().kappa * std::pow(theta.q - wing().theta_0, 2);
  };
  const double start = energy();
  for (int i = 0; i < 1000; ++i) {
    theta = solver.step(theta, body_, angles, Loads());
    ASSERT_NEAR(energy(), start, 1e-12 * start);
  }
}

/// The spring of a step is taken at the new angle, exactly as Newmark's implicit step wants it.
TEST_F(Pendulum, StepSolvesTheEquationAtTheNewAngle) {
  Newmark newmark;
  newmark.dt = 0.3 * period();
  const WingPitchSolver solver(Side::kRight, insect_, kGravity, newmark);
  JointAngles angles;
  Coordinate& theta = angles.wings.right.theta;
  theta = {0.7, -0.4, 0.9};
  const Coordinate next = solver.step(theta, body_, angles, Loads());
  theta = next;
  EXPECT_NEAR(next.qdd, solver.acceleration(body_, angles, Loads()), 1e-12 * std::abs(next.qdd));
}

/// A wing on a horizontal hinge hangs: its weight acts at the mass centre, m g nu_x cos(theta).
TEST(WingPitch, FeelsItsWeight) {
  Insect insect = testing::largeMonarch();
  insect.beta = 0.0;
  for (Side side : kSides) insect.wings[side].kappa = 0.0;
  const WingPitchSolver solver(Side::kRight, insect, kGravity, Newmark());
  for (double theta : {0.0, 0.5, 1.5}) {
    JointAngles angles;
    angles.wings.right.theta.q = theta;
    // nu_x < 0: the mass lies behind the hinge and falls, which pitches the wing up (theta > 0).
    const Appendage& wing = insect.wings.right.plate;
    const double expected = -wing.m * kGravity * wing.nu.x() * std::cos(theta) / wing.J(1, 1);
    EXPECT_NEAR(solver.acceleration(BodyState(), angles, Loads()), expected, 1e-12 * expected);
    EXPECT_GT(expected, 0.0);
  }
}

/// A body in free fall carries its wing along: neither weight nor inertia is left.
TEST(WingPitch, FallsFreelyWithItsBody) {
  const Insect insect = testing::largeMonarch();
  const WingPitchSolver solver(Side::kRight, insect, kGravity, Newmark());
  BodyState body = withPitch(BodyState(), {0.4, 0.0, 0.0});
  body.a.z() = kGravity;
  WingAngles own;
  own.phi.q = 0.5;
  own.psi.q = -0.1;
  own.theta.q = insect.wings.right.theta_0;
  const JointAngles angles{both(own), {}};
  EXPECT_NEAR(solver.acceleration(body, angles, Loads()), 0.0, 1e-11);
}

TEST(WingPitch, NeedsInertia) {
  Insect insect = testing::largeMonarch();
  for (Side side : kSides) insect.wings[side].plate.J.setZero();
  EXPECT_THROW(WingPitchSolver(Side::kRight, insect, kGravity, Newmark()), std::invalid_argument);
}

}  // namespace
}  // namespace monarch_flight
