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

void StepModel::begin(const Interface& committed, const PrescribedState& prescribed,
                      std::uint32_t step) {
  committed_ = committed;
  prescribed_ = prescribed;
  step_ = step;
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
  Interface next = prescribed_.interface();
  next.body.a.x() = a(0);
  next.body.a.z() = a(1);
  next.body.pitch.qdd = a(2);
  next.theta_R.qdd = a(3);
  const Interface from = model_.departure(step_, committed_, next);
  next.body = advancedBody(from.body, prescribed_.body, model_.free, model_.newmark, a.head<3>());
  next.theta_R = model_.free.wing_pitch ? model_.newmark.advance(from.theta_R, a(3))
                                        : prescribed_.angles.theta;
  return next;
}

CouplingVector StepModel::residual(const CouplingVector& d, const Loads& loads) const {
  const Interface guess = interface(d);
  const JointAngles guessed = prescribed_.anglesWith(guess.theta_R);
  const Interface from = model_.departure(step_, committed_, guess);
  Interface answer = guess;
  answer.body = flight_.step(from.body, prescribed_.body, guess.body, guessed, loads);
  if (wing_) {
    answer.theta_R = wing_->step(from.theta_R, answer.body, guessed, loads, prescribed_.rest_angle);
  }
  return increments(answer) - d;
}

void StepModel::airMotion(const CouplingVector& d, Vector6d& velocity,
                          Vector6d& acceleration) const {
  const Interface guess = interface(d);
  const WingMotion motion =
      relativeTo(prescribed_.wind,
                 rightWingMotion(model_.insect, guess.body, prescribed_.anglesWith(guess.theta_R)));
  velocity << motion.v_W, motion.omega_W;
  acceleration << motion.a_W, motion.alpha_W;
}

}  // namespace monarch_flight
