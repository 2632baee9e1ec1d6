#include "monarch_flight/coupling/interface_balance.h"

#include <array>

namespace monarch_flight {
namespace {

using Matrix6x4 = Eigen::Matrix<double, 6, 4>;
using Matrix15x4 = Eigen::Matrix<double, 15, 4>;

Vector6d acceleration(const WingMotion& motion) {
  Vector6d a;
  a << motion.a_W, motion.alpha_W;
  return a;
}

/// Power of loads along a rigid motion of the wing.
double along(const WingMotion& motion, const Loads& loads) {
  return loads.force().dot(motion.v_W) + loads.moment().dot(motion.omega_W);
}

/// d(a_W; alpha_W)/d(x'', z'', theta_B'', theta_R''): rigid motion is linear in the accelerations.
Matrix6x4 wingAcceleration(const Insect& insect, const Interface& at, const JointAngles& angles) {
  const Vector6d base = acceleration(rightWingMotion(insect, at.body, angles));
  Matrix6x4 T;
  for (int i = 0; i < 4; ++i) {
    Interface moved = at;
    JointAngles turned = angles;
    if (i == 0) moved.body.a.x() += 1.0;
    if (i == 1) moved.body.a.z() += 1.0;
    if (i == 2) moved.body.Omega_dot_B.y() += 1.0;
    if (i == 3) turned.theta.qdd += 1.0;
    T.col(i) = acceleration(rightWingMotion(insect, moved.body, turned)) - base;
  }
  return T;
}

}  // namespace

InterfaceBalance::InterfaceBalance(const CoupledModel& model) : model_(model) {
  if (!model.insect.bare_wing) dynamics_.emplace(model.insect, model.gravity);
}

InterfacePower InterfaceBalance::power(const PrescribedState& prescribed, const Interface& guess,
                                       const Interface& answer, const Loads& loads) const {
  InterfacePower power;
  const Insect& insect = model_.insect;
  power.fluid =
      along(rightWingMotion(insect, guess.body, prescribed.anglesWith(guess.theta_R)), loads);
  const JointAngles angles = prescribed.anglesWith(answer.theta_R);
  if (!dynamics_) {
    power.structure = along(rightWingMotion(insect, answer.body, angles), loads);
    return power;
  }
  const InsectMotion motion = insectMotion(insect.beta, answer.body, angles);
  Vector15d velocity;
  velocity << motion.body.v, motion.body.Omega_B, motion.joints[0].Omega, motion.joints[1].Omega,
      motion.joints[2].Omega;
  std::array<Vector6d, 3> applied;
  applied.fill(Vector6d::Zero());
  applied[0] << loads.force(), loads.moment();
  power.structure = dynamics_->appliedForce(motion, applied).dot(velocity);
  return power;
}

double InterfaceBalance::addedMassRatio(const PrescribedState& prescribed,
                                        const Interface& interface,
                                        const Matrix6d& added_mass) const {
  const JointAngles angles = prescribed.anglesWith(interface.theta_R);
  const Matrix6x4 T = wingAcceleration(model_.insect, interface, angles);
  Eigen::Matrix4d air = T.transpose() * added_mass * T, structure = Eigen::Matrix4d::Zero();
  if (dynamics_) {
    air *= 2.0;
    Matrix15x4 B = Matrix15x4::Zero();  // rows: x', Omega of body, right wing, left wing, abdomen
    B(0, 0) = B(2, 1) = B(4, 2) = B(7, 3) = B(10, 3) = 1.0;
    structure = B.transpose() *
                dynamics_->inertia(insectMotion(model_.insect.beta, interface.body, angles)) * B;
  } else {
    structure(3, 3) = model_.insect.right.J(1, 1);
  }
  const FreeCoordinates& free = model_.free;
  const std::array<bool, 4> is_free = {free.x, free.z, free.pitch, free.wing_pitch};
  for (int i = 0; i < 4; ++i) {
    if (is_free[static_cast<std::size_t>(i)]) continue;
    air.row(i).setZero();
    air.col(i).setZero();
    structure.row(i).setZero();
    structure.col(i).setZero();
    structure(i, i) = 1.0;
  }
  air = 0.5 * (air + air.transpose().eval());  // a grid's added mass is symmetric to rounding only
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix4d> solver(air, structure,
                                                                         Eigen::EigenvaluesOnly);
  return solver.info() == Eigen::Success ? solver.eigenvalues().cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace monarch_flight
