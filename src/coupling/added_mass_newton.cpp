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
    for (Side side : model_.sides()) update(side, trial);
  }
  previous_ = trial;
}

void AddedMassNewton::update(Side side, const Trial& trial) {
  LoadOperator& at_hand = (*operator_)[side];
  const AirMotion now = model_.airMotion(side, trial.d);
  const AirMotion before = model_.airMotion(side, previous_->d);
  const Vector6d du = now.velocity - before.velocity, loads = vector(trial.loads[side]);
  const Vector6d change = loads - vector(previous_->loads[side]);
  const Vector6d missing = change - at_hand.velocity * du -
                           at_hand.acceleration * (now.acceleration - before.acceleration);
  Vector6d weighted = du;  // velocities of the same size for both halves
  weighted.tail<3>() *= length_scale_ * length_scale_;
  const double size = weighted.dot(du);
  const bool heard = change.head<3>().norm() > kNoise * loads.head<3>().norm() &&
                     change.tail<3>().norm() > kNoise * loads.tail<3>().norm();
  if (size > 0.0 && heard) at_hand.velocity += missing * (weighted / size).transpose();
}

PerWing<Loads> AddedMassNewton::predicted(const Trial& trial, const CouplingVector& d) const {
  PerWing<Loads> loads = trial.loads;
  for (Side side : model_.sides()) {
    const LoadOperator& K = (*operator_)[side];
    const AirMotion now = model_.airMotion(side, d), then = model_.airMotion(side, trial.d);
    const Vector6d change = K.velocity * (now.velocity - then.velocity) +
                            K.acceleration * (now.acceleration - then.acceleration);
    loads[side].force_pressure += change.head<3>();
    loads[side].moment_pressure += change.tail<3>();
  }
  if (model_.sides().count == 1) loads.left = loads.right;
  return loads;
}

/// Where both wings pitch freely: how far they pitch alike, and against each other. In a symmetric
/// step nothing of the first ever reaches the second, so that it stays symmetric to the last bit.
CouplingVector AddedMassNewton::toModes(const CouplingVector& d) const {
  CouplingVector modes = d;
  if (model_.free()[kThetaR] && model_.free()[kThetaL]) {
    modes(kThetaR) = 0.5 * (d(kThetaR) + d(kThetaL));
    modes(kThetaL) = 0.5 * (d(kThetaR) - d(kThetaL));
  }
  return modes;
}

CouplingVector AddedMassNewton::fromModes(const CouplingVector& modes) const {
  CouplingVector d = modes;
  if (model_.free()[kThetaR] && model_.free()[kThetaL]) {
    d(kThetaR) = modes(kThetaR) + modes(kThetaL);
    d(kThetaL) = modes(kThetaR) - modes(kThetaL);
  }
  return d;
}

/// dr/dd of the predicted problem, in modes; minus the identity where a coordinate is prescribed.
/// What a mirror turns round gets differences of both signs, so that a flight and its mirror image
/// are solved alike.
CoordinateMatrix AddedMassNewton::residualJacobian(const Trial& trial,
                                                   const CouplingVector& base) const {
  CoordinateMatrix J = -CoordinateMatrix::Identity();
  for (std::size_t i = 0; i < kCoordinates; ++i) {
    if (!model_.free()[i]) continue;
    const auto column = static_cast<Eigen::Index>(i);
    const CouplingVector step = fromModes(kDifference * CouplingVector::Unit(column));
    const auto at = [&](const CouplingVector& d) {
      return model_.residual(d, predicted(trial, d));
    };
    const bool turned = i == kY || i == kRoll || i == kYaw || i == kThetaL;
    const CouplingVector change =
        turned ? CouplingVector(0.5 * (at(trial.d + step) - at(trial.d - step)))
               : CouplingVector(at(trial.d + step) - base);
    J.col(column) = toModes(change / kDifference);
  }
  return J;
}

Proposal AddedMassNewton::advance(const Trial& trial) {
  learn(trial);
  ++advances_;
  const CouplingVector base = model_.residual(trial.d, trial.loads);
  const CouplingVector offset = trial.residual - base;  // participants may differ from their copy
  const Eigen::PartialPivLU<CoordinateMatrix> factor(residualJacobian(trial, base));
  CouplingVector d = trial.d, residual = trial.residual;
  for (int i = 0; i < kNewton; ++i) {
    const CouplingVector step = fromModes(factor.solve(toModes(residual)));
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
  PerWing<LoadOperator> at_hand = operator_.value_or(PerWing<LoadOperator>());
  state("operator_known", known);
  state("operator_velocity", at_hand.right.velocity);
  state("operator_acceleration", at_hand.right.acceleration);
  state("operator_left_velocity", at_hand.left.velocity);
  state("operator_left_acceleration", at_hand.left.acceleration);
  state("operator_fetched", fetched_);
  state("operator_missed", missed_);
  if (!state.loading()) return;
  operator_.reset();
  if (known) operator_ = at_hand;
}

}  // namespace monarch_flight
