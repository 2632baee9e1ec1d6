#include "monarch_flight/flight/multibody_dynamics.h"

#include <stdexcept>

#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// First row of the block of appendage i in the 15 velocities.
Eigen::Index jointRow(std::size_t i) { return 6 + 3 * static_cast<Eigen::Index>(i); }

/// G_i: joint velocity and angular velocity, appendage axes, to momentum and angular momentum about
/// the joint.
Matrix6d spatialInertia(const Appendage& part) {
  const Eigen::Matrix3d m_nu = part.m * hat(part.nu);
  Matrix6d G;
  G << part.m * Eigen::Matrix3d::Identity(), -m_nu, m_nu, part.J;
  return G;
}

/// X_i: (x', Omega, Omega_i) to joint velocity and total angular velocity in appendage axes.
Eigen::Matrix<double, 6, 9> jointMap(const Appendage& part, const BodyState& body,
                                     const JointState& joint) {
  const Eigen::Matrix3d Q_t = joint.Q.transpose();
  Eigen::Matrix<double, 6, 9> X = Eigen::Matrix<double, 6, 9>::Zero();
  X.block<3, 3>(0, 0) = (body.R_IB() * joint.Q).transpose();
  X.block<3, 3>(0, 3) = -Q_t * hat(part.mu);
  X.block<3, 3>(3, 3) = Q_t;
  X.block<3, 3>(3, 6).setIdentity();
  return X;
}

/// X_i^T load of each appendage in rows 1-6 and in its own rows. The wings are added to each other
/// first: the mirror image of a flight then has the same sums to the last bit.
Vector15d generalised(const std::array<Eigen::Matrix<double, 6, 9>, 3>& X,
                      const std::array<Vector6d, 3>& loads) {
  std::array<Eigen::Matrix<double, 9, 1>, 3> each;
  Vector15d sum;
  for (std::size_t i = 0; i < 3; ++i) {
    each[i] = X[i].transpose() * loads[i];
    sum.segment<3>(jointRow(i)) = each[i].tail<3>();
  }
  sum.head<6>() = (each[0].head<6>() + each[1].head<6>()) + each[2].head<6>();
  return sum;
}

/// Total angular velocity of an appendage, own axes.
Eigen::Vector3d totalRate(const BodyState& body, const JointState& joint) {
  return joint.Omega + joint.Q.transpose() * body.Omega_B;
}

/// Absolute velocity of an appendage's joint, own axes.
Eigen::Vector3d jointVelocity(const Appendage& part, const BodyState& body,
                              const JointState& joint) {
  return joint.Q.transpose() * (body.R_IB().transpose() * body.v + body.Omega_B.cross(part.mu));
}

/// Inertial force and moment about the joint of one appendage, own axes.
Vector6d inertialLoad(const Appendage& part, const BodyState& body, const JointState& joint) {
  const Eigen::Matrix3d Q_t = joint.Q.transpose();
  const Eigen::Vector3d body_rate = Q_t * body.Omega_B;
  const Eigen::Vector3d w = joint.Omega + body_rate;
  const Eigen::Vector3d w_dot =
      joint.Omega_dot + Q_t * body.Omega_dot_B + body_rate.cross(joint.Omega);
  const Eigen::Vector3d a =
      Q_t * (body.R_IB().transpose() * body.a + body.Omega_dot_B.cross(part.mu) +
             body.Omega_B.cross(body.Omega_B.cross(part.mu)));
  Vector6d load;
  load << part.m * (a + w_dot.cross(part.nu) + w.cross(w.cross(part.nu))),
      part.m * part.nu.cross(a) + part.J * w_dot + w.cross(part.J * w);
  return load;
}

InsectMotion withoutAccelerations(InsectMotion motion) {
  motion.body.a.setZero();
  motion.body.Omega_dot_B.setZero();
  for (JointState& joint : motion.joints) joint.Omega_dot.setZero();
  return motion;
}

}  // namespace

InsectMotion insectMotion(double beta, const BodyState& body, const JointAngles& angles) {
  InsectMotion motion;
  motion.body = body;
  const Eigen::Vector3d mirror_axial(-1.0, 1.0,
                                     -1.0);  // of angular velocities, across the x-z plane
  const auto& [right, left] = angles.wings;
  motion.joints[0] = {wingAttitude(Side::kRight, beta, right), wingRate(right),
                      wingRateDerivative(right)};
  motion.joints[1] = {wingAttitude(Side::kLeft, beta, left),
                      mirror_axial.cwiseProduct(wingRate(left)),
                      mirror_axial.cwiseProduct(wingRateDerivative(left))};
  motion.joints[2] = {abdomenAttitude(angles), angles.theta_A.qd * Eigen::Vector3d::UnitY(),
                      angles.theta_A.qdd * Eigen::Vector3d::UnitY()};
  return motion;
}

MultibodyDynamics::MultibodyDynamics(const Insect& insect, double gravity)
    : insect_(insect),
      appendages_{insect.wings.right.plate, mirrored(insect.wings.left.plate), insect.abdomen},
      gravity_(gravity) {
  if (insect.bare_wing) {
    throw std::invalid_argument("multibody dynamics need an insect with a body, not a bare wing");
  }
}

std::array<Eigen::Matrix<double, 6, 9>, 3> MultibodyDynamics::jointMaps(
    const InsectMotion& motion) const {
  std::array<Eigen::Matrix<double, 6, 9>, 3> X;
  for (std::size_t i = 0; i < 3; ++i)
    X[i] = jointMap(appendages_[i], motion.body, motion.joints[i]);
  return X;
}

Matrix15d MultibodyDynamics::inertia(const InsectMotion& motion) const {
  Matrix15d J = Matrix15d::Zero();
  J.block<3, 3>(0, 0) = insect_.m_B * Eigen::Matrix3d::Identity();
  J.block<3, 3>(3, 3) = insect_.J_B;
  const auto X = jointMaps(motion);
  std::array<Matrix9d, 3> parts;
  for (std::size_t i = 0; i < 3; ++i) {
    parts[i] = X[i].transpose() * spatialInertia(appendages_[i]) * X[i];
    const Eigen::Index row = jointRow(i);
    J.block<6, 3>(0, row) = parts[i].topRightCorner<6, 3>();
    J.block<3, 6>(row, 0) = parts[i].bottomLeftCorner<3, 6>();
    J.block<3, 3>(row, row) = parts[i].bottomRightCorner<3, 3>();
  }
  const auto body = [&parts](std::size_t i) { return parts[i].topLeftCorner<6, 6>(); };
  J.block<6, 6>(0, 0) += (body(0) + body(1)) + body(2);
  return J;
}

Vector15d MultibodyDynamics::inertialForce(const InsectMotion& motion) const {
  const BodyState& body = motion.body;
  std::array<Vector6d, 3> loads;
  for (std::size_t i = 0; i < 3; ++i)
    loads[i] = inertialLoad(appendages_[i], body, motion.joints[i]);
  Vector15d sum = appliedForce(motion, loads);
  sum.head<3>() += insect_.m_B * body.a;
  sum.segment<3>(3) +=
      insect_.J_B * body.Omega_dot_B + body.Omega_B.cross(insect_.J_B * body.Omega_B);
  return sum;
}

Vector15d MultibodyDynamics::bias(const InsectMotion& motion) const {
  return inertialForce(withoutAccelerations(motion));
}

Vector15d MultibodyDynamics::gravityForce(const InsectMotion& motion) const {
  const Eigen::Vector3d g_B = gravity_ * motion.body.R_IB().transpose() * Eigen::Vector3d::UnitZ();
  std::array<Vector6d, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d weight = appendages_[i].m * (motion.joints[i].Q.transpose() * g_B);
    weights[i] << weight, appendages_[i].nu.cross(weight);
  }
  Vector15d sum = appliedForce(motion, weights);
  sum(2) += insect_.m_B * gravity_;
  return sum;
}

Vector15d MultibodyDynamics::airForce(const InsectMotion& motion,
                                      const PerWing<Loads>& loads) const {
  const Loads left = mirrored(loads.left);
  std::array<Vector6d, 3> applied;
  applied[0] << loads.right.force(), loads.right.moment();
  applied[1] << left.force(), left.moment();
  applied[2].setZero();
  return appliedForce(motion, applied);
}

Vector15d MultibodyDynamics::appliedForce(const InsectMotion& motion,
                                          const std::array<Vector6d, 3>& loads) const {
  return generalised(jointMaps(motion), loads);
}

std::array<Eigen::Vector3d, 3> MultibodyDynamics::jointTorques(const InsectMotion& motion,
                                                               const PerWing<Loads>& loads) const {
  const Vector15d torque = inertialForce(motion) - gravityForce(motion) - airForce(motion, loads);
  return {torque.segment<3>(6), torque.segment<3>(9), torque.segment<3>(12)};
}

double MultibodyDynamics::kineticEnergy(const InsectMotion& motion) const {
  const BodyState& body = motion.body;
  double energy =
      0.5 * (insect_.m_B * body.v.squaredNorm() + body.Omega_B.dot(insect_.J_B * body.Omega_B));
  for (std::size_t i = 0; i < 3; ++i) {
    Vector6d twist;
    twist << jointVelocity(appendages_[i], body, motion.joints[i]),
        totalRate(body, motion.joints[i]);
    energy += 0.5 * twist.dot(spatialInertia(appendages_[i]) * twist);
  }
  return energy;
}

double MultibodyDynamics::potentialEnergy(const InsectMotion& motion) const {
  return -insect_.totalMass() * gravity_ * massCentre(motion).z();
}

Eigen::Vector3d MultibodyDynamics::linearMomentum(const InsectMotion& motion) const {
  Eigen::Vector3d momentum = insect_.m_B * motion.body.v;
  for (std::size_t i = 0; i < 3; ++i) {
    const Appendage& part = appendages_[i];
    const JointState& joint = motion.joints[i];
    const Eigen::Vector3d v =
        jointVelocity(part, motion.body, joint) + totalRate(motion.body, joint).cross(part.nu);
    momentum += part.m * (motion.body.R_IB() * (joint.Q * v));
  }
  return momentum;
}

Eigen::Vector3d MultibodyDynamics::angularMomentum(const InsectMotion& motion) const {
  const BodyState& body = motion.body;
  Eigen::Vector3d momentum =
      body.R_IB() * (insect_.J_B * body.Omega_B) + insect_.m_B * body.x.cross(body.v);
  for (std::size_t i = 0; i < 3; ++i) {
    const Appendage& part = appendages_[i];
    const Eigen::Matrix3d R_IA = body.R_IB() * motion.joints[i].Q;
    Vector6d twist;
    twist << jointVelocity(part, body, motion.joints[i]), totalRate(body, motion.joints[i]);
    const Vector6d p = spatialInertia(part) * twist;  // momentum; angular momentum about the joint
    const Eigen::Vector3d joint_I = body.x + body.R_IB() * part.mu;
    momentum += R_IA * p.tail<3>() + joint_I.cross(R_IA * p.head<3>());
  }
  return momentum;
}

Eigen::Vector3d MultibodyDynamics::massCentre(const InsectMotion& motion) const {
  const BodyState& body = motion.body;
  Eigen::Vector3d moment = insect_.m_B * body.x;
  for (std::size_t i = 0; i < 3; ++i) {
    const Appendage& part = appendages_[i];
    moment += part.m * (body.x + body.R_IB() * (part.mu + motion.joints[i].Q * part.nu));
  }
  return moment / insect_.totalMass();
}

}  // namespace monarch_flight
