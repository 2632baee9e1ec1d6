#include "monarch_flight/coupling/step_model.h"

namespace monarch_flight {

StepModel::StepModel(const CoupledModel& model, double length_scale)
    : model_(model), flight_(model.insect, model.gravity, model.free, model.newmark) {
  const double unit = 1.0 / (model.newmark.beta * model.newmark.dt * model.newmark.dt);
  for (std::size_t i = 0; i < kCoordinates; ++i)
    scales_(i) = kCoordinateTable[i].translation ? length_scale * unit : unit;
  if (!model.free.wingPitch()) return;
  for (Side side : sides()) wings_[side].emplace(side, model.insect, model.gravity, model.newmark);
}

void StepModel::begin(const Interface& committed, const PrescribedState& prescribed,
                      std::uint32_t step) {
  committed_ = committed;
  prescribed_ = prescribed;
  step_ = step;
}

CouplingVector StepModel::increments(const Interface& interface) const {
  CouplingVector d = accelerations(interface).cwiseQuotient(scales_);
  for (std::size_t i = 0; i < kCoordinates; ++i) {
    if (!model_.free[i]) d(i) = 0.0;
  }
  return d;
}

Interface StepModel::interface(const CouplingVector& increments) const {
  const CouplingVector a = increments.cwiseProduct(scales_);
  Interface next = prescribed_.interface();
  next.body.a = a.head<3>();
  next.body.Omega_dot_B = a.segment<3>(kRoll);
  next.body.pitch.qdd = a(kPitch);
  next.theta.right.qdd = a(kThetaR);
  next.theta.left.qdd = a(kThetaL);
  const Interface from = model_.departure(step_, committed_, next);
  next.body = advancedBody(from.body, prescribed_.body, model_.free, model_.newmark, a.head<6>());
  for (Side side : sides()) {
    next.theta[side] = wings_[side] ? model_.newmark.advance(from.theta[side], next.theta[side].qdd)
                                    : prescribed_.angles.wings[side].theta;
  }
  if (model_.mirrored) next.theta.left = next.theta.right;
  return next;
}

CouplingVector StepModel::residual(const CouplingVector& d, const PerWing<Loads>& loads) const {
  const Interface guess = interface(d);
  const JointAngles guessed = prescribed_.anglesWith(guess.theta);
  const Interface from = model_.departure(step_, committed_, guess);
  Interface answer = guess;
  answer.body = flight_.step(from.body, prescribed_.body, guess.body, guessed, loads);
  for (Side side : sides()) {
    if (!wings_[side]) continue;
    answer.theta[side] = wings_[side]->step(from.theta[side], answer.body, guessed, loads[side],
                                            prescribed_.rest_angle[side]);
  }
  return increments(answer) - d;
}

AirMotion StepModel::airMotion(Side side, const CouplingVector& d) const {
  const Interface guess = interface(d);
  const WingMotion motion = wingMotionInAir(side, model_.insect, prescribed_.wind, guess.body,
                                            prescribed_.anglesWith(guess.theta));
  AirMotion seen;
  seen.velocity << motion.v_W, motion.omega_W;
  seen.acceleration << motion.a_W, motion.alpha_W;
  return seen;
}

}  // namespace monarch_flight
