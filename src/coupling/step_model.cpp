#include "monarch_flight/coupling/step_model.h"

namespace monarch_flight {

StepModel::StepModel(const CoupledModel& model, double length_scale)
    : model_(model),
      free_{model.free.x, model.free.z, model.free.pitch, model.free.wing_pitch},
      flight_(model.insect, model.gravity, model.free, model.newmark) {
  const double unit = 1.0 / (model.newmark.beta * model.newmark.dt * model.newmark.dt);
  scales_ << length_scale * unit, length_scale * unit, unit, unit;
  if (model.free.wing_pitch) wing_.emplace(model.insect, model.gravity, model.newmark);
}

void StepModel::begin(const Interface& committed, double t) {
  committed_ = committed;
  const PrescribedState state = model_.motion->at(t);
  prescribed_ = {state.body, state.angles.theta};
  prescribed_angles_ = state.angles;
}

JointAngles StepModel::angles(const Coordinate& theta_R) const {
  JointAngles angles = prescribed_angles_;
  angles.theta = theta_R;
  return angles;
}

CouplingVector StepModel::increments(const Interface& interface) const {
  const CouplingVector a(interface.body.a.x(), interface.body.a.z(), interface.body.pitch.qdd,
                         interface.theta_R.qdd);
  CouplingVector d = CouplingVector::Zero();
  for (Eigen::Index i = 0; i < 4; ++i) {
    if (free_[static_cast<std::size_t>(i)]) d(i) = a(i) / scales_(i);
  }
  return d;
}

Interface StepModel::interface(const CouplingVector& increments) const {
  const CouplingVector a = increments.cwiseProduct(scales_);
  Interface next = prescribed_;
  next.body =
      advancedBody(committed_.body, prescribed_.body, model_.free, model_.newmark, a.head<3>());
  if (model_.free.wing_pitch) next.theta_R = model_.newmark.advance(committed_.theta_R, a(3));
  return next;
}

CouplingVector StepModel::residual(const CouplingVector& d, const Loads& loads) const {
  const Interface guess = interface(d);
  const JointAngles guessed = angles(guess.theta_R);
  Interface answer = guess;
  answer.body = flight_.step(committed_.body, prescribed_.body, guess.body, guessed, loads);
  if (wing_) answer.theta_R = wing_->step(committed_.theta_R, answer.body, guessed, loads);
  return increments(answer) - d;
}

void StepModel::airMotion(const CouplingVector& d, Vector6d& velocity,
                          Vector6d& acceleration) const {
  const Interface guess = interface(d);
  const WingMotion motion = rightWingMotion(model_.insect, guess.body, angles(guess.theta_R));
  velocity << motion.v_W - motion.R_IW.transpose() * model_.wind_I, motion.omega_W;
  acceleration << motion.a_W, motion.alpha_W;
}

}  // namespace monarch_flight
