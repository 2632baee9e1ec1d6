#include "monarch_flight/guidance/lateral_control.h"

#include <algorithm>
#include <cmath>

namespace monarch_flight {
namespace {

constexpr double kRamp = 2.0;  // flaps in which a turn reaches its rate
enum { kSide, kRollAngle, kRollRate, kHeading, kHeadingRate };

}  // namespace

LateralControl::LateralControl(const LateralSettings& settings, int samples, bool wing_pitch)
    : settings_(settings), samples_(samples), wing_pitch_(wing_pitch), law_(settings.gains) {
  commands_ = ControlInput::Zero(law_.gains().size());
  deviation_ = LateralState::Zero(wing_pitch ? kLateralStates : kLateralStates - 2);
  start();
}

void LateralControl::start() {
  law_.start();
  begun_ = false;
  now_ = {};
  side_velocity_ = heading_ = reference_ = turn_rate_ = origin_ = 0.0;
  heading_sum_ = side_sum_ = levels_ = 0.0;
}

void LateralControl::average(const HeadingMotion& now, double side_velocity) {
  if (!begun_) {
    heading_ = now.yaw.q;
  } else {
    const double before = heading_;
    heading_ += std::remainder(now.yaw.q - heading_, 2.0 * M_PI);
    heading_sum_ += 0.5 * (before + heading_);
    side_sum_ += 0.5 * (side_velocity_ + side_velocity);
    levels_ += 1.0;
  }
  now_ = now;
  side_velocity_ = side_velocity;
  begun_ = true;
}

void LateralControl::move(int phase, double flaps, std::optional<double> wanted, bool active) {
  if (levels_ > 0.0) {
    const double part = 1.0 / samples_, mean_reference = reference_ + 0.5 * flaps * turn_rate_;
    const Eigen::Index before = (phase + samples_ - 1) % samples_;
    const auto orbit = [&](int k) { return 0.5 * (stateOf(before, k) + stateOf(phase, k)); };
    if (active)
      law_.integrate(phase, {part * (heading_sum_ / levels_ - mean_reference - orbit(kHeading)),
                             part * (side_sum_ / levels_ - orbit(kSide))});
    reference_ += flaps * turn_rate_;
    heading_sum_ = side_sum_ = levels_ = 0.0;
  }
  if (flaps == 0.0) origin_ = reference_ = heading_ - settings_.states(phase, kHeading);
  if (active) steer(wanted.value_or(origin_));
  if (!active) turn_rate_ = 0.0;
}

/// A state at a sample of the turn that is being flown.
double LateralControl::stateOf(Eigen::Index phase, Eigen::Index state) const {
  return settings_.states(phase, state) + turn_rate_ * settings_.turn_states(phase, state);
}

/// Up to the turn rate, and down again in time to end at the heading that is wanted: from a rate r,
/// less by `change` at every further sample, the way is r (r + change) / (2 change N).
void LateralControl::steer(double wanted) {
  const double N = samples_, way = wanted - reference_, most = settings_.turn;
  const double change = most / (kRamp * N), half = 0.5 * change;
  const double braking = std::sqrt(half * half + 2.0 * change * N * std::abs(way)) - half;
  const double rate = std::copysign(std::min({most, braking, N * std::abs(way)}), way);
  turn_rate_ = std::clamp(rate, turn_rate_ - change, turn_rate_ + change);
}

void LateralControl::refer() {
  commands_ = settings_.commands + turn_rate_ * settings_.turn_commands;
  law_.refer(commands_);
}

bool LateralControl::feedBack(int phase, const Interface& at, double lost_roll,
                              const std::array<Coordinate, kCommands>& applied) {
  deviation_(kSide) = side_velocity_;
  deviation_(kRollAngle) = now_.roll.q;
  deviation_(kRollRate) = now_.roll.qd;
  deviation_(kHeading) = heading_ - reference_;
  deviation_(kHeadingRate) = now_.yaw.qd;
  if (wing_pitch_) {
    const auto& [right, left] = at.theta;
    deviation_.tail<2>() << 0.5 * (right.q - left.q), 0.5 * (right.qd - left.qd);
  }
  for (Eigen::Index k = 0; k < deviation_.size(); ++k) deviation_(k) -= stateOf(phase, k);
  if (!deviation_.allFinite() || !(std::abs(deviation_(kRollAngle)) <= lost_roll)) return false;
  law_.feedBack(phase, deviation_, applied);
  return true;
}

void LateralControl::memory(StateVisitor& state) {
  law_.memory(state, "lateral");
  state("lateral_begun", begun_);
  state("lateral_heading", heading_);
  state("lateral_origin", origin_);
  state("lateral_reference", reference_);
  state("lateral_turn_rate", turn_rate_);
  state("lateral_side_velocity", side_velocity_);
  state("lateral_heading_sum", heading_sum_);
  state("lateral_side_sum", side_sum_);
  state("lateral_levels", levels_);
}

}  // namespace monarch_flight
