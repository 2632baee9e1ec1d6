#include <cmath>

#include "monarch_flight/coupling/accelerator.h"

namespace monarch_flight {
namespace {

constexpr int kNewton = 4;            // steps at most
constexpr double kSolved = 1e-14;     // change of d at which the predicted problem is solved
constexpr double kDifference = 1e-5;  // of d, for the Jacobian of flight and wing
constexpr double kNoise = 1e-11;      // relative change of the loads that teaches nothing
constexpr std::uint32_t kRest = 10;   // steps between operators asked for out of turn, at least

Vector6d vector(const Loads& loads) {
  Vector6d all;
  all << loads.force(), loads.moment();
  return all;
}

}  // namespace

AddedMassNewton::AddedMassNewton(const StepModel& model, double length_scale, int operator_every)
    : model_(model), length_scale_(length_scale), operator_every_(operator_every) {}

void AddedMassNewton::beginStep(std::uint32_t step) {
  previous_.reset();
  advances_ = 0;
  step_ = step;
}

void AddedMassNewton::forget() {
  previous_.reset();
  operator_.reset();
}

// One more trial costs less than an operator, so it takes a bad step to ask out of turn. A flow
// that starts with a time scheme of lower order has another operator from its second step on.
bool AddedMassNewton::wantsOperator(int operator_cost) const {
  if (!operator_) return true;
  if (advances_ > 0) return false;
  const std::uint32_t age = step_ - fetched_;
  return operator_cost == 0 || fetched_ == 1 ||
         age >= static_cast<std::uint32_t>(operator_every_) || (missed_ && age >= kRest);
}

/// The fluid's own operator, or Broyden's update of the one at hand by the change from the last
/// trial of this step.
void AddedMassNewton::learn(const Trial& trial) {
  if (trial.jacobian) {
    operator_ = trial.jacobian;
    fetched_ = step_;
  } else if (previous_ && operator_) {
    Vector6d u, a, u_before, a_before;
    model_.airMotion(trial.d, u, a);
    model_.airMotion(previous_->d, u_before, a_before);
    const Vector6d du = u - u_before, change = vector(trial.loads) - vector(previous_->loads);
    const Vector6d missing =
        change - operator_->velocity * du - operator_->acceleration * (a - a_before);
    Vector6d weighted = du;  // velocities of the same size for both halves
    weighted.tail<3>() *= length_scale_ * length_scale_;
    const double size = weighted.dot(du);
    const Vector6d loads = vector(trial.loads);
    const bool heard = change.head<3>().norm() > kNoise * loads.head<3>().norm() &&
                       change.tail<3>().norm() > kNoise * loads.tail<3>().norm();
    if (size > 0.0 && heard) operator_->velocity += missing * (weighted / size).transpose();
  }
  previous_ = trial;
}

Loads AddedMassNewton::predicted(const Trial& trial, const CouplingVector& d) const {
  Vector6d u, a, u_trial, a_trial;
  model_.airMotion(d, u, a);
  model_.airMotion(trial.d, u_trial, a_trial);
  const Vector6d change =
      operator_->velocity * (u - u_trial) + operator_->acceleration * (a - a_trial);
  Loads loads = trial.loads;
  loads.force_pressure += change.head<3>();
  loads.moment_pressure += change.tail<3>();
  return loads;
}

/// dr/dd of the predicted problem; minus the identity where a coordinate is prescribed.
Eigen::Matrix4d AddedMassNewton::residualJacobian(const Trial& trial,
                                                  const CouplingVector& base) const {
  Eigen::Matrix4d J = -Eigen::Matrix4d::Identity();
  for (int i = 0; i < 4; ++i) {
    if (!model_.isFree()[static_cast<std::size_t>(i)]) continue;
    CouplingVector d = trial.d;
    d(i) += kDifference;
    J.col(i) = (model_.residual(d, predicted(trial, d)) - base) / kDifference;
  }
  return J;
}

Proposal AddedMassNewton::advance(const Trial& trial) {
  learn(trial);
  ++advances_;
  const CouplingVector base = model_.residual(trial.d, trial.loads);
  const CouplingVector offset = trial.residual - base;  // participants may differ from their copy
  const Eigen::PartialPivLU<Eigen::Matrix4d> factor(residualJacobian(trial, base));
  CouplingVector d = trial.d, residual = trial.residual;
  for (int i = 0; i < kNewton; ++i) {
    const CouplingVector step = factor.solve(residual);
    if (!step.allFinite()) break;
    d -= step;
    if (step.cwiseAbs().maxCoeff() <= kSolved) break;
    residual = model_.residual(d, predicted(trial, d)) + offset;
  }
  return {d, 1.0, predicted(trial, d)};
}

void AddedMassNewton::endStep(const Trial& last) {
  learn(last);
  missed_ = advances_ > 2;
}

void AddedMassNewton::memory(StateVisitor& state) {
  bool known = operator_.has_value();
  LoadOperator at_hand = operator_.value_or(LoadOperator());
  state("operator_known", known);
  state("operator_velocity", at_hand.velocity);
  state("operator_acceleration", at_hand.acceleration);
  state("operator_fetched", fetched_);
  state("operator_missed", missed_);
  if (!state.loading()) return;
  operator_.reset();
  if (known) operator_ = at_hand;
}

}  // namespace monarch_flight
