// Instantaneous laws of the multibody dynamics in general three-dimensional motion.
#include <gtest/gtest.h>

#include <functional>

#include "core/test_insect.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::largeMonarch;
using testing::Random;

constexpr double kGravity = 9.81;

WingAngles wingAt(double t, double shift) {
  return {testing::wave(0.1, 0.9, 1.0, shift, t), testing::wave(-0.2, 0.4, 1.3, 2.0 * shift, t),
          testing::wave(0.3, 0.7, 0.8, 0.5 - shift, t)};
}

/// The wings alike, or each its own way.
JointAngles anglesAt(double t, double right, double left) {
  return {{wingAt(t, right), wingAt(t, left)}, testing::wave(0.4, 0.5, 1.1, right, t)};
}

/// A smooth motion without any symmetry: each wing, the abdomen and the body go their own way.
InsectMotion motionAt(double t) {
  InsectMotion motion;
  const WingAngles attitude = wingAt(t, 0.7);
  BodyState& body = motion.body;
  for (int i = 0; i < 3; ++i) {
    const Coordinate c = testing::wave(0.2 * i, 1.0 - 0.3 * i, 0.9 + 0.2 * i, 1.0 * i, t);
    body.x(i) = c.q;
    body.v(i) = c.qd;
    body.a(i) = c.qdd;
  }
  body.q_IB = wingAttitude(Side::kRight, 0.3, attitude);
  body.Omega_B = wingRate(attitude);
  body.Omega_dot_B = wingRateDerivative(attitude);
  const WingAngles right = wingAt(t, 0.1), left = wingAt(t, -1.2), abdomen = wingAt(t, 2.2);
  const Vector3d axial(-1.0, 1.0, -1.0);
  motion.joints[0] = {wingAttitude(Side::kRight, 0.4, right), wingRate(right),
                      wingRateDerivative(right)};
  motion.joints[1] = {wingAttitude(Side::kLeft, 0.4, left), axial.cwiseProduct(wingRate(left)),
                      axial.cwiseProduct(wingRateDerivative(left))};
  motion.joints[2] = {wingAttitude(Side::kRight, -0.2, abdomen), wingRate(abdomen),
                      wingRateDerivative(abdomen)};
  return motion;
}

/// Each wing its own.
PerWing<Loads> differentLoads(unsigned seed) {
  Random random(seed);
  const Loads right = random.loads(), left = random.loads();
  return {right, left};
}

/// Central difference of tenth order; with this step and frequencies of order one, exact to 1e-13.
template <typename Value>
Value derivative(const std::function<Value(double)>& f, double t) {
  constexpr double h = 0.015;
  constexpr double c[5] = {5.0 / 6.0, -5.0 / 21.0, 5.0 / 84.0, -5.0 / 504.0, 1.0 / 1260.0};
  Value sum = c[0] * (f(t + h) - f(t - h));
  for (int k = 2; k <= 5; ++k) sum += c[k - 1] * (f(t + k * h) - f(t - k * h));
  return sum / h;
}

TEST(InsectMotion, RatesAreTheDerivativesOfTheAttitudes) {
  for (double t : {0.3, 2.1, 4.4}) {
    auto at = [](double s) { return insectMotion(0.4, BodyState(), anglesAt(s, 0.1, -1.2)); };
    for (std::size_t i = 0; i < 3; ++i) {
      const Matrix3d Q_dot = derivative<Matrix3d>([&](double s) { return at(s).joints[i].Q; }, t);
      const JointState joint = at(t).joints[i];
      EXPECT_LT((vee(joint.Q.transpose() * Q_dot) - joint.Omega).norm(), 1e-12) << i;
      const Vector3d rate_dot =
          derivative<Vector3d>([&](double s) { return at(s).joints[i].Omega; }, t);
      EXPECT_LT((rate_dot - joint.Omega_dot).norm(), 1e-12) << i;
    }
  }
}

TEST(InsectMotion, LeftWingIsTheMirrorImage) {
  const Matrix3d mirror = Vector3d(1.0, -1.0, 1.0).asDiagonal();
  const InsectMotion motion = insectMotion(0.4, BodyState(), anglesAt(1.0, 0.1, 0.1));
  EXPECT_LT((motion.joints[1].Q - mirror * motion.joints[0].Q * mirror).norm(), 1e-15);
  Random random(1);
  const Loads right = random.loads(), left = mirrored(right);
  EXPECT_EQ(left.force(), mirror * right.force());
  EXPECT_EQ(left.moment(), -mirror * right.moment());
}

class Dynamics : public ::testing::TestWithParam<double> {
 protected:
  const double t_ = GetParam();
  const MultibodyDynamics dynamics_{largeMonarch(), kGravity};
  const InsectMotion motion_ = motionAt(t_);
  const Vector15d xi_ = testing::velocities(motion_);
};

TEST_P(Dynamics, InertialForceIsInertiaTimesAccelerationPlusBias) {
  const Matrix15d J = dynamics_.inertia(motion_);
  const Vector15d force = J * testing::accelerations(motion_) + dynamics_.bias(motion_);
  EXPECT_LT((dynamics_.inertialForce(motion_) - force).norm(), 1e-13 * force.norm());
  EXPECT_LT((J - J.transpose()).norm(), 1e-15 * J.norm());
  EXPECT_EQ(Eigen::LLT<Matrix15d>(J).info(), Eigen::Success);
}

TEST_P(Dynamics, KineticEnergyIsTheQuadraticForm) {
  const double energy = 0.5 * xi_.dot(dynamics_.inertia(motion_) * xi_);
  EXPECT_NEAR(dynamics_.kineticEnergy(motion_), energy, 1e-14 * energy);
}

TEST_P(Dynamics, PowerOfTheInertialSideIsTheRateOfKineticEnergy) {
  const double rate =
      derivative<double>([&](double s) { return dynamics_.kineticEnergy(motionAt(s)); }, t_);
  const Vector15d force = dynamics_.inertialForce(motion_);
  EXPECT_NEAR(xi_.dot(force), rate, 1e-12 * xi_.norm() * force.norm());
}

TEST_P(Dynamics, FirstRowsAreTheRateOfLinearMomentum) {
  const Vector3d rate = derivative<Vector3d>(
      [&](double s) -> Vector3d { return dynamics_.linearMomentum(motionAt(s)); }, t_);
  EXPECT_LT((dynamics_.inertialForce(motion_).head<3>() - rate).norm(), 1e-12 * rate.norm());
  const Vector3d velocity = derivative<Vector3d>(
      [&](double s) -> Vector3d { return dynamics_.massCentre(motionAt(s)); }, t_);
  EXPECT_LT((dynamics_.linearMomentum(motion_) - largeMonarch().totalMass() * velocity).norm(),
            1e-12 * dynamics_.linearMomentum(motion_).norm());
}

TEST_P(Dynamics, MomentRowsAreTheRateOfAngularMomentum) {
  const Vector3d rate = derivative<Vector3d>(
      [&](double s) -> Vector3d { return dynamics_.angularMomentum(motionAt(s)); }, t_);
  const Vector15d force = dynamics_.inertialForce(motion_);
  const Vector3d moment =
      motion_.body.x.cross(force.head<3>()) + motion_.body.R_IB() * force.segment<3>(3);
  EXPECT_LT((moment - rate).norm(), 1e-12 * rate.norm());
}

/// Rows 7-15: the rate of each appendage's angular momentum about its moving joint.
TEST_P(Dynamics, JointRowsAreTheAppendagesOwnMoments) {
  const Insect insect = largeMonarch();
  const Appendage parts[3] = {insect.wings.right.plate, mirrored(insect.wings.left.plate),
                              insect.abdomen};
  const Vector15d force = dynamics_.inertialForce(motion_);
  for (std::size_t i = 0; i < 3; ++i) {
    const Appendage& part = parts[i];
    auto R = [&](double s) -> Matrix3d {
      return motionAt(s).body.R_IB() * motionAt(s).joints[i].Q;
    };
    auto joint = [&](double s) -> Vector3d {
      return motionAt(s).body.x + motionAt(s).body.R_IB() * part.mu;
    };
    auto spin = [&](double s) -> Vector3d {  // J w, inertial axes
      const InsectMotion m = motionAt(s);
      return R(s) * (part.J * (m.joints[i].Omega + m.joints[i].Q.transpose() * m.body.Omega_B));
    };
    auto velocity = [&](double s) -> Vector3d { return derivative<Vector3d>(joint, s); };
    const Vector3d moment = derivative<Vector3d>(spin, t_) +
                            part.m * (R(t_) * part.nu).cross(derivative<Vector3d>(velocity, t_));
    EXPECT_LT((R(t_).transpose() * moment - force.segment<3>(6 + 3 * i)).norm(),
              1e-12 * force.norm())
        << i;
  }
}

TEST_P(Dynamics, PowerOfGravityIsTheLossOfPotentialEnergy) {
  const double rate =
      derivative<double>([&](double s) { return dynamics_.potentialEnergy(motionAt(s)); }, t_);
  const Vector15d force = dynamics_.gravityForce(motion_);
  EXPECT_NEAR(xi_.dot(force), -rate, 1e-12 * force.norm() * xi_.norm());
  EXPECT_LT((force.head<3>() - largeMonarch().totalMass() * kGravity * Vector3d::UnitZ()).norm(),
            1e-14 * force.norm());
}

TEST_P(Dynamics, PowerOfTheAirIsThatOfForcesAtTheJointsAndMoments) {
  const Insect insect = largeMonarch();
  const PerWing<Loads> both = differentLoads(7);
  const Loads right = both.right, left = mirrored(both.left);
  double power = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Loads& loads = i == 0 ? right : left;
    const Vector3d mu = i == 0 ? insect.wings.right.plate.mu : mirrored(insect.wings.left.plate).mu;
    const JointState& joint = motion_.joints[i];
    const Vector3d v_I = motion_.body.v + motion_.body.R_IB() * motion_.body.Omega_B.cross(mu);
    const Vector3d w = joint.Omega + joint.Q.transpose() * motion_.body.Omega_B;
    power += (motion_.body.R_IB() * (joint.Q * loads.force())).dot(v_I) + loads.moment().dot(w);
  }
  const Vector15d force = dynamics_.airForce(motion_, both);
  EXPECT_NEAR(xi_.dot(force), power, 1e-13 * force.norm() * xi_.norm());
}

/// model.md section 2: rows 4-6 of the air are sum (mu x Q F + Q M).
TEST_P(Dynamics, MomentOfTheAirAboutTheBodysCentre) {
  const Insect insect = largeMonarch();
  const PerWing<Loads> both = differentLoads(8);
  const Loads right = both.right, left = mirrored(both.left);
  const Matrix3d& Q_R = motion_.joints[0].Q;
  const Matrix3d& Q_L = motion_.joints[1].Q;
  const Vector3d mu_R = insect.wings.right.plate.mu, mu_L = mirrored(insect.wings.left.plate).mu;
  const Vector3d moment = mu_R.cross(Q_R * right.force()) + Q_R * right.moment() +
                          mu_L.cross(Q_L * left.force()) + Q_L * left.moment();
  const Vector15d force = dynamics_.airForce(motion_, both);
  EXPECT_LT((force.segment<3>(3) - moment).norm(), 1e-14 * force.norm());
  EXPECT_EQ(Vector3d(force.tail<3>()), Vector3d::Zero());
}

TEST_P(Dynamics, JointTorquesCloseTheEquations) {
  const PerWing<Loads> loads = differentLoads(9);
  const auto torque = dynamics_.jointTorques(motion_, loads);
  const Vector15d sum = dynamics_.gravityForce(motion_) + dynamics_.airForce(motion_, loads);
  const Vector15d force = dynamics_.inertialForce(motion_);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((sum.segment<3>(6 + 3 * i) + torque[i] - force.segment<3>(6 + 3 * i)).norm(),
              1e-14 * force.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Times, Dynamics, ::testing::Values(0.0, 0.37, 1.9, 3.3, 5.2));

TEST(DynamicsOfABareWing, AreRefused) {
  Insect wing = largeMonarch();
  wing.bare_wing = true;
  EXPECT_THROW(MultibodyDynamics(wing, kGravity), std::invalid_argument);
}

}  // namespace
}  // namespace monarch_flight
