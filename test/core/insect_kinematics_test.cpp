#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "monarch_flight/insect/build.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

/// Sum of two sines: a smooth coordinate with known derivatives.
struct Wave {
  double a, w, p, b, v, q;
  explicit Wave(std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    a = u(random), p = 3 * u(random), b = 0.5 * u(random), q = 3 * u(random);
    w = 2.0 + u(random), v = 4.0 + u(random);
  }
  Coordinate at(double t) const {
    return {a * std::sin(w * t + p) + b * std::sin(v * t + q),
            a * w * std::cos(w * t + p) + b * v * std::cos(v * t + q),
            -a * w * w * std::sin(w * t + p) - b * v * v * std::sin(v * t + q)};
  }
};

/// General motion: three body angles (z-y-x), position and joint angles are waves.
struct Motion {
  Wave x, y, z, roll, pitch, yaw, phi, psi, theta;
  explicit Motion(std::mt19937& r)
      : x(r), y(r), z(r), roll(r), pitch(r), yaw(r), phi(r), psi(r), theta(r) {}

  Eigen::Matrix3d attitude(double t) const {
    return rotationZ(yaw.at(t).q) * rotationY(pitch.at(t).q) * rotationX(roll.at(t).q);
  }
  /// Body angular velocity in body axes, from the angles' rates.
  Eigen::Vector3d Omega(double t) const {
    const Eigen::Matrix3d Rx = rotationX(roll.at(t).q), Ry = rotationY(pitch.at(t).q);
    return Eigen::Vector3d(roll.at(t).qd, 0, 0) +
           Rx.transpose() * Eigen::Vector3d(0, pitch.at(t).qd, 0) +
           Rx.transpose() * Ry.transpose() * Eigen::Vector3d(0, 0, yaw.at(t).qd);
  }
  BodyState body(double t) const;
  WingAngles wing(double t) const { return {phi.at(t), psi.at(t), theta.at(t)}; }
};

/// Sixth-order central difference.
template <typename Value>
Value difference(const std::function<Value(double)>& f, double t, double h) {
  return (45.0 * (f(t + h) - f(t - h)) - 9.0 * (f(t + 2 * h) - f(t - 2 * h)) +
          (f(t + 3 * h) - f(t - 3 * h))) /
         (60.0 * h);
}

BodyState Motion::body(double t) const {
  BodyState b;
  b.x << x.at(t).q, y.at(t).q, z.at(t).q;
  b.v << x.at(t).qd, y.at(t).qd, z.at(t).qd;
  b.a << x.at(t).qdd, y.at(t).qdd, z.at(t).qdd;
  b.q_IB = attitude(t);
  b.Omega_B = Omega(t);
  b.Omega_dot_B = difference<Eigen::Vector3d>(
      [this](double s) -> Eigen::Vector3d { return Omega(s); }, t, 1e-3);
  return b;
}

constexpr double kStep = 1e-3;

TEST(Kinematics, WingRateIsTheDerivativeOfTheAttitude) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const Motion m(random);
    const double t = 0.1 * trial;
    const auto Q = [&](double s) -> Eigen::Matrix3d {
      return wingAttitude(Side::kRight, 0.44, m.wing(s));
    };
    const Eigen::Matrix3d Qd = difference<Eigen::Matrix3d>(Q, t, kStep);
    EXPECT_LT((Q(t).transpose() * Qd - hat(wingRate(m.wing(t)))).norm(), 1e-10);
    const Eigen::Vector3d rate_dot = difference<Eigen::Vector3d>(
        [&](double s) -> Eigen::Vector3d { return wingRate(m.wing(s)); }, t, kStep);
    EXPECT_LT((rate_dot - wingRateDerivative(m.wing(t))).norm(), 1e-9);
  }
}

TEST(Kinematics, WingMotionIsConsistentForAnyBodyMotion) {
  std::mt19937 random(11);
  Insect insect = makeBareWing("wing", {}, Planform::rectangle(0.02, 0.05, 0.25));
  insect.beta = 0.44;
  insect.wings.right.plate.mu << 0.3, -0.2, 0.5;
  insect.wings.left.plate.mu << 0.1, 0.4, -0.3;
  for (int trial = 0; trial < 20; ++trial) {
    const Side side = kSides[static_cast<std::size_t>(trial) % 2];
    const Motion m(random);
    const double t = 0.1 * trial;
    const auto at = [&](double s) {
      JointAngles angles;
      angles.wings[side] = m.wing(s);
      return wingMotion(side, insect, m.body(s), angles);
    };
    const WingMotion w = at(t);
    const Eigen::Vector3d r_dot = difference<Eigen::Vector3d>(
        [&](double s) -> Eigen::Vector3d { return at(s).r_I; }, t, kStep);
    EXPECT_LT((w.R_IW * w.v_W - r_dot).norm(), 1e-10);
    const Eigen::Matrix3d R_dot = difference<Eigen::Matrix3d>(
        [&](double s) -> Eigen::Matrix3d { return at(s).R_IW; }, t, kStep);
    EXPECT_LT((w.R_IW.transpose() * R_dot - hat(w.omega_W)).norm(), 1e-10);
    const Eigen::Vector3d v_dot = difference<Eigen::Vector3d>(
        [&](double s) -> Eigen::Vector3d { return at(s).R_IW * at(s).v_W; }, t, kStep);
    EXPECT_LT((w.R_IW * w.a_W - v_dot).norm(), 1e-8);
    const Eigen::Vector3d omega_dot = difference<Eigen::Vector3d>(
        [&](double s) -> Eigen::Vector3d { return at(s).omega_W; }, t, kStep);
    EXPECT_LT((w.alpha_W - omega_dot).norm(), 1e-8);
  }
}

TEST(Kinematics, LeftWingIsTheMirrorImage) {
  std::mt19937 random(3);
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, -1, 1).asDiagonal();
  const Appendage right =
      plateWing(Planform::rectangle(0.02, 0.05, 0.25), 1e-5, Eigen::Vector3d(0.001, 0.003, -0.002));
  const Appendage left = mirrored(right);
  for (int trial = 0; trial < 20; ++trial) {
    const WingAngles angles = Motion(random).wing(0.3);
    const Eigen::Matrix3d QR = wingAttitude(Side::kRight, 0.44, angles);
    const Eigen::Matrix3d QL = wingAttitude(Side::kLeft, 0.44, angles);
    EXPECT_LT((QL - mirror * QR * mirror).norm(), 1e-15);
    EXPECT_LT((left.mu + QL * left.nu - mirror * (right.mu + QR * right.nu)).norm(), 1e-17);
    const Eigen::Matrix3d JR = QR * right.J * QR.transpose();
    EXPECT_LT((QL * left.J * QL.transpose() - mirror * JR * mirror).norm(), 1e-20);
  }
}

/// The left wing where it is, seen in the plane y = 0, is the right wing that wingMotion tells of.
TEST(Kinematics, MotionOfTheLeftWingIsSeenInAMirror) {
  std::mt19937 random(5);
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, -1, 1).asDiagonal();
  Insect insect = makeBareWing("wing", {}, Planform::rectangle(0.02, 0.05, 0.25));
  insect.beta = 0.44;
  insect.wings.left.plate.mu << 0.1, 0.4, -0.3;
  for (int trial = 0; trial < 20; ++trial) {
    const Motion m(random);
    JointAngles angles;
    angles.wings.left = m.wing(0.3);
    const BodyState body = m.body(0.3);
    const WingMotion seen = wingMotion(Side::kLeft, insect, body, angles);
    const Eigen::Vector3d root = body.x + body.R_IB() * mirrored(insect.wings.left.plate).mu;
    const Eigen::Matrix3d R = body.R_IB() * wingAttitude(Side::kLeft, 0.44, angles.wings.left);
    EXPECT_LT((seen.r_I - mirror * root).norm(), 1e-15);
    EXPECT_LT((seen.R_IW - mirror * R * mirror).norm(), 1e-14);
  }
}

TEST(Kinematics, AttitudesAtNamedAngles) {
  WingAngles wing;
  wing.phi.q = M_PI / 2.0;  // wing tip down
  EXPECT_LT((wingAttitude(Side::kRight, 0.0, wing).col(1) - Eigen::Vector3d::UnitZ()).norm(),
            1e-15);
  wing = {};
  wing.theta.q = M_PI / 2.0;  // leading edge up
  EXPECT_LT((wingAttitude(Side::kRight, 0.0, wing).col(0) + Eigen::Vector3d::UnitZ()).norm(),
            1e-15);
  wing = {};
  wing.psi.q = M_PI / 2.0;  // tip forward
  EXPECT_LT((wingAttitude(Side::kRight, 0.0, wing).col(1) - Eigen::Vector3d::UnitX()).norm(),
            1e-15);
  JointAngles angles;
  angles.theta_A.q = 0.3;
  EXPECT_LT((abdomenAttitude(angles) - rotationY(0.3)).norm(), 1e-15);
}

TEST(Kinematics, WithPitchSetsAttitudeAndRates) {
  BodyState body;
  body.v << 1, 2, 3;
  const BodyState b = withPitch(body, {0.3, 2.0, -5.0});
  EXPECT_LT((b.R_IB() - rotationY(0.3)).norm(), 1e-15);
  EXPECT_EQ(b.Omega_B, Eigen::Vector3d(0, 2, 0));
  EXPECT_EQ(b.Omega_dot_B, Eigen::Vector3d(0, -5, 0));
  EXPECT_EQ(b.pitch.q, 0.3);
  EXPECT_EQ(b.v, Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace monarch_flight
