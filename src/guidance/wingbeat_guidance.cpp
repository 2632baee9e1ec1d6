#include "monarch_flight/guidance/wingbeat_guidance.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

constexpr int kSamples = 360;  // of a flap, for the means

/// A series swung and shifted: q + swing (q - mean) + shift.
Coordinate swung(const Coordinate& s, double mean, const Coordinate& swing,
                 const Coordinate& shift) {
  const double from_mean = s.q - mean;
  return {s.q + swing.q * from_mean + shift.q,
          s.qd + (swing.q * s.qd + swing.qd * from_mean) + shift.qd,
          s.qdd + (swing.q * s.qdd + 2.0 * swing.qd * s.qd + swing.qdd * from_mean) + shift.qdd};
}

Coordinate shifted(const Coordinate& s, const Coordinate& shift) {
  return {s.q + shift.q, s.qd + shift.qd, s.qdd + shift.qdd};
}

/// s(tau(t)) for tau' = 1 + f.
Coordinate retimed(const Coordinate& s, const Coordinate& f) {
  const double rate = 1.0 + f.q;
  return {s.q, s.qd * rate, s.qdd * (rate * rate) + s.qd * f.qd};
}

const WingbeatSettings& checked(const WingbeatSettings& settings) {
  const std::vector<std::string> faults = settings.problems();
  if (!faults.empty()) throw InputError(faults);
  return settings;
}

}  // namespace

std::vector<std::string> WingbeatSettings::problems() const {
  std::vector<std::string> faults;
  const auto fault = [&faults](const std::string& key, double value, const std::string& bound) {
    std::ostringstream text;
    text << "guidance/" << key << " = " << value << ": must be " << bound;
    faults.push_back(text.str());
  };
  if (!(std::isfinite(frequency) && frequency > 0.0))
    fault("type: the motion's frequency", frequency,
          "> 0 Hz for a wingbeat that is led; give motion/frequency");
  if (!(std::isfinite(time_constant) && time_constant > 0.0))
    fault("time_constant", time_constant, "> 0 flaps; 0.25 is usual");
  for (std::size_t i = 0; i < kCommands; ++i) {
    const CommandLimits& l = limits[i];
    const std::string name = std::string("limits/") + kCommandTable[i].name;
    if (!(std::isfinite(l.low) && l.low <= 0.0))
      fault(name + "[0]", l.low, "<= 0; 0 is no command");
    if (!(std::isfinite(l.high) && l.high >= 0.0))
      fault(name + "[1]", l.high, ">= 0; 0 is no command");
    if (!(std::isfinite(l.rate) && l.rate > 0.0))
      fault(std::string("rates/") + kCommandTable[i].name, l.rate, "> 0 a flap; 1 is usual");
    const bool relative = i == kAmplitudeCommand || i == kFrequencyCommand;
    const CommandLimits& apart = limits[kDifferentialAmplitude];
    const double least = i == kAmplitudeCommand ? l.low - std::max(-apart.low, apart.high) : l.low;
    if (relative && l.low > -1.0 && !(least > -1.0))
      fault(name + "[0] less limits/differential_amplitude", least,
            "> -1: both wings must beat; make either smaller");
    if (relative && !(l.low > -1.0))
      fault(name + "[0]", l.low, "> -1: the wings must beat; -0.25 is usual");
  }
  return faults;
}

WingbeatGuidance::WingbeatGuidance(std::shared_ptr<const PrescribedMotion> motion,
                                   std::shared_ptr<const WindModel> wind,
                                   const WingbeatSettings& settings, double t_start,
                                   std::unique_ptr<CommandSource> source)
    : motion_(std::move(motion)),
      wind_(std::move(wind)),
      settings_(checked(settings)),
      abdomen_mean_(0.0),
      source_(std::move(source)) {
  for (int i = 0; i < kSamples; ++i) {
    const JointAngles angles = motion_->at(t_start + i / (kSamples * settings_.frequency)).angles;
    for (Side side : kSides) phi_mean_[side] += angles.wings[side].phi.q / kSamples;
    abdomen_mean_ += angles.theta_A.q / kSamples;
  }
  for (const CommandLimits& limits : settings_.limits)
    filters_.emplace_back(settings_.time_constant, limits.rate);
}

PrescribedState WingbeatGuidance::start(double t) {
  for (CommandFilter& filter : filters_) filter.reset();
  applied_ = {};
  report_ = {};
  report_.phase = settings_.frequency * t;
  if (source_) source_->start();
  PrescribedState state = at(t);
  state.wind = wind_->at(t, state.body.x, state.body.v, state.body.a);
  return state;
}

PrescribedState WingbeatGuidance::next(const GuidanceInput& input) {
  if (source_) {
    const auto wanted = source_->next(
        {input, report_.phase, settings_.frequency, settings_.dt, report_.command, applied_});
    if (wanted) take(*wanted);
    report_.lost = source_->lost();
  }
  for (std::size_t i = 0; i < kCommands; ++i) {
    filters_[i].advance(report_.command.*kCommandTable[i].value, settings_.dt);
    applied_[i] = filters_[i].value();
    report_.applied.*kCommandTable[i].value = applied_[i].q;
  }
  PrescribedState state = at(input.t);
  state.wind = windAhead(*wind_, input);
  return state;
}

/// Within the bounds; a command that is not all finite numbers is not taken at all.
void WingbeatGuidance::take(const WingbeatChange& wanted) {
  WingbeatChange within;
  bool clipped = false;
  for (std::size_t i = 0; i < kCommands; ++i) {
    const double value = wanted.*kCommandTable[i].value;
    if (!std::isfinite(value)) {
      ++report_.refused;
      return;
    }
    const CommandLimits& limits = settings_.limits[i];
    const double kept = std::clamp(value, limits.low, limits.high);
    clipped = clipped || kept != value;
    within.*kCommandTable[i].value = kept;
  }
  report_.clipped += clipped ? 1 : 0;
  report_.command = within;
}

PrescribedState WingbeatGuidance::at(double t) {
  const double tau = t + filters_[kFrequencyCommand].integral();
  report_.phase = settings_.frequency * tau;
  PrescribedState state = motion_->at(t);
  const Coordinate& f = applied_[kFrequencyCommand];
  if (tau != t || f.q != 0.0 || f.qd != 0.0) {
    const JointAngles joints = motion_->at(tau).angles;
    for (Side side : kSides) {
      const auto& [phi, psi, theta] = joints.wings[side];
      state.angles.wings[side] = {retimed(phi, f), retimed(psi, f), retimed(theta, f)};
    }
    state.angles.theta_A = retimed(joints.theta_A, f);
  }
  for (Side side : kSides) {
    WingAngles& wing = state.angles.wings[side];
    wing.phi = swung(wing.phi, phi_mean_[side], command(kAmplitudeCommand, side),
                     command(kFlappingMeanCommand, side));
    wing.psi = shifted(wing.psi, command(kDeviationMeanCommand, side));
    state.rest_angle[side] = command(kRestAngleCommand, side).q;
  }
  JointAngles& a = state.angles;
  a.theta_A = swung(a.theta_A, abdomen_mean_, applied_[kAbdomenAmplitudeCommand],
                    applied_[kAbdomenMeanCommand]);
  return state;
}

/// What the wing gets of a command: both sides alike, and the difference.
Coordinate WingbeatGuidance::command(Command both, Side side) const {
  const auto difference = differenceOf(both);
  if (!difference) return applied_[both];
  const Coordinate &sum = applied_[both], &half = applied_[*difference];
  const double sign = side == Side::kRight ? 1.0 : -1.0;
  return {sum.q + sign * half.q, sum.qd + sign * half.qd, sum.qdd + sign * half.qdd};
}

void WingbeatGuidance::memory(StateVisitor& state) {
  for (std::size_t i = 0; i < kCommands; ++i) {
    const std::string name = kCommandTable[i].name;
    filters_[i].memory(state, ("filter_" + name).c_str());
    state(("command_" + name).c_str(), report_.command.*kCommandTable[i].value);
    state(("applied_" + name).c_str(), report_.applied.*kCommandTable[i].value);
    if (state.loading()) applied_[i] = filters_[i].value();
  }
  state("phase", report_.phase);
  state("clipped", report_.clipped);
  state("refused", report_.refused);
  state("lost", report_.lost);
  if (source_) source_->memory(state);
}

}  // namespace monarch_flight
