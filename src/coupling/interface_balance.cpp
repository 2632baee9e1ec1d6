#include "monarch_flight/coupling/interface_balance.h"

#include <array>

namespace monarch_flight {
namespace {

constexpr int n = kCoordinates;
using Matrix6xN = Eigen::Matrix<double, 6, n>;
using Matrix15xN = Eigen::Matrix<double, 15, n>;

Vector6d acceleration(const WingMotion& motion) {
  Vector6d a;
  a << motion.a_W, motion.alpha_W;
  return a;
}

/// Power of loads along a rigid motion of the wing.
double along(const WingMotion& motion, const Loads& loads) {
  return loads.force().dot(motion.v_W) + loads.moment().dot(motion.omega_W);
}

/// d(a_W; alpha_W) of a wing / d(accelerations of the coordinates): rigid motion is linear in them.
Matrix6xN wingAcceleration(Side side, const Insect& insect, const Interface& at,
                           const JointAngles& angles) {
  const Vector6d base = acceleration(wingMotion(side, insect, at.body, angles));
  Matrix6xN T = Matrix6xN::Zero();
  for (int i = 0; i < 6; ++i) {
    BodyState body = at.body;
    (i < 3 ? body.a : body.Omega_dot_B)(i % 3) += 1.0;
    T.col(i) = acceleration(wingMotion(side, insect, body, angles)) - base;
  }
  JointAngles turned = angles;
  turned.wings[side].theta.qdd += 1.0;
  T.col(side == Side::kRight ? kThetaR : kThetaL) =
      acceleration(wingMotion(side, insect, at.body, turned)) - base;
  return T;
}

}  // namespace

InterfaceBalance::InterfaceBalance(const CoupledModel& model) : model_(model) {
  if (!model.insect.bare_wing) dynamics_.emplace(model.insect, model.gravity);
}

InterfacePower InterfaceBalance::power(const PrescribedState& prescribed, const Interface& guess,
                                       const Interface& answer, const PerWing<Loads>& loads) const {
  InterfacePower power;
  const Insect& insect = model_.insect;
  const JointAngles guessed = prescribed.anglesWith(guess.theta);
  const JointAngles answered = prescribed.anglesWith(answer.theta);
  for (Side side : model_.sides()) {
    power.fluid += along(wingMotion(side, insect, guess.body, guessed), loads[side]);
    if (!dynamics_)
      power.structure += along(wingMotion(side, insect, answer.body, answered), loads[side]);
  }
  if (!dynamics_) return power;
  const InsectMotion motion = insectMotion(insect.beta, answer.body, answered);
  Vector15d velocity;
  velocity << motion.body.v, motion.body.Omega_B, motion.joints[0].Omega, motion.joints[1].Omega,
      motion.joints[2].Omega;
  PerWing<Loads> solved = loads;
  if (model_.mirrored) solved.left = Loads();
  power.structure = dynamics_->airForce(motion, solved).dot(velocity);
  return power;
}

double InterfaceBalance::addedMassRatio(const PrescribedState& prescribed,
                                        const Interface& interface,
                                        const PerWing<Matrix6d>& added_mass) const {
  const JointAngles angles = prescribed.anglesWith(interface.theta);
  CoordinateMatrix air = CoordinateMatrix::Zero(), structure = CoordinateMatrix::Zero();
  for (Side side : model_.sides()) {
    const Matrix6xN T = wingAcceleration(side, model_.insect, interface, angles);
    air += T.transpose() * added_mass[side] * T;
  }
  if (dynamics_) {
    Matrix15xN B = Matrix15xN::Zero();  // rows: x', Omega of body, right wing, left wing, abdomen
    B.topLeftCorner<6, 6>().setIdentity();
    B(7, kThetaR) = B(10, kThetaL) = 1.0;
    if (model_.mirrored) {
      air *= 2.0;
      B(10, kThetaR) = 1.0;
    }
    structure = B.transpose() *
                dynamics_->inertia(insectMotion(model_.insect.beta, interface.body, angles)) * B;
  } else {
    structure(kThetaR, kThetaR) = model_.insect.wings.right.plate.J(1, 1);
  }
  for (int i = 0; i < n; ++i) {
    if (model_.free[static_cast<std::size_t>(i)]) continue;
    air.row(i).setZero();
    air.col(i).setZero();
    structure.row(i).setZero();
    structure.col(i).setZero();
    structure(i, i) = 1.0;
  }
  air = 0.5 * (air + air.transpose().eval());  // a grid's added mass is symmetric to rounding only
  const Eigen::GeneralizedSelfAdjointEigenSolver<CoordinateMatrix> solver(air, structure,
                                                                          Eigen::EigenvaluesOnly);
  return solver.info() == Eigen::Success ? solver.eigenvalues().cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace monarch_flight
