// Periodic flights under constant commands.
#include <algorithm>
#include <cmath>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/trim/control_design.h"
#include "monarch_flight/trim/trim.h"
#include "trim/control_scales.h"

namespace monarch_flight {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kVelocity = 0.01;  // a miss of the mean velocity by it counts 1 [m/s]

/// Between dimensionless unknowns (states, commands) and trims.
class CommandedFlap {
 public:
  CommandedFlap(const PhaseMap& map, const ControlOptions& options, double speed, double climb,
                const ControlTrim& guess)
      : map_(map), inputs_(options.inputs), point_(guess), n_(controlStates(map.baseCase())) {
    wanted_ = SetPoint{0.0, speed, climb}.velocity();
    point_.speed = speed;
    point_.climb = climb;
  }

  VectorXd unknowns() const {
    VectorXd y(n_ + static_cast<Index>(inputs_.size()));
    y.head(n_) = scaled(point_.start, n_);
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      y(n_ + static_cast<Index>(i)) =
          point_.wingbeat.command.*kCommandTable[inputs_[i]].value / commandScale(inputs_[i]);
    return y;
  }

  ControlTrim at(const VectorXd& y) const {
    ControlTrim trim = point_;
    const VectorXd scales = VectorXd(trimScales()).head(n_);
    trim.start = with(trim.start, y.head(n_).cwiseProduct(scales));
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const double value = y(n_ + static_cast<Index>(i)) * commandScale(inputs_[i]);
      trim.wingbeat.command.*kCommandTable[inputs_[i]].value = value;
      trim.wingbeat.filters[inputs_[i]] = {value, 0.0, 0.0};
    }
    return trim;
  }

  std::optional<TrimResidual> residual(const VectorXd& y) const {
    const ControlTrim trim = at(y);
    const FlapState rates = map_.ratesAt(0, trim.start, trim.wingbeat);
    const PhaseFlight flight = map_.fly(0, trim.start, trim.wingbeat, map_.samples(), &rates);
    if (!flight.complete) return std::nullopt;
    TrimResidual r;
    r.periodicity = scaled(flight.states.back() - trim.start, n_);
    r.targets = (flight.velocity - wanted_) / kVelocity;
    return r;
  }

 private:
  const PhaseMap& map_;
  const std::vector<std::size_t>& inputs_;
  ControlTrim point_;
  Index n_;
  Eigen::Vector2d wanted_;
};

NewtonSettings searchSettings(const ControlOptions& options, bool known) {
  NewtonSettings s;
  s.tolerance = 1e-5;
  s.step_tolerance = 1e-4;
  s.max_iterations = 15;
  s.max_step = 1.0;
  s.damping = 0.0;
  s.broyden = known;
  const auto m = static_cast<Index>(options.inputs.size());
  s.lower.resize(m);
  s.upper.resize(m);
  for (Index i = 0; i < m; ++i) {
    const std::size_t k = options.inputs[static_cast<std::size_t>(i)];
    s.lower(i) = options.limits[k].low / commandScale(k);
    s.upper(i) = options.limits[k].high / commandScale(k);
  }
  return s;
}

}  // namespace

double commandScale(std::size_t command) {
  constexpr double kDegree = M_PI / 180.0;
  switch (command) {
    case kAmplitudeCommand:
    case kFrequencyCommand:
      return 0.1;
    case kDeviationMeanCommand:
      return 5.0 * kDegree;
    case kFlappingMeanCommand:
    case kRestAngleCommand:
      return 10.0 * kDegree;
    case kAbdomenMeanCommand:
      return 15.0 * kDegree;
    default:
      return 0.5;  // kAbdomenAmplitudeCommand
  }
}

VectorXd scaled(const FlapState& state, Index n) {
  const FlapState all = state.cwiseQuotient(trimScales());
  VectorXd part(n);
  for (Index i = 0; i < n; ++i) part(i) = all(i);
  return part;
}

FlapState with(FlapState state, const VectorXd& components) {
  for (Index i = 0; i < components.size(); ++i) state(i) = components(i);
  return state;
}

int controlStates(const Case& c) { return c.free[kThetaR] ? 6 : 4; }

std::array<CommandLimits, kCommands> ControlOptions::usualLimits(const std::string& config_dir) {
  constexpr double kQuick = 20.0;  // of the upper limit a flap: the law's filters are fast
  std::array<CommandLimits, kCommands> limits = defaultCommandLimits(config_dir);
  for (CommandLimits& l : limits) l.rate = kQuick * l.high;
  return limits;
}

WingbeatSettings wingbeatSettings(const Case& c, const ControlOptions& options) {
  WingbeatSettings s;
  s.limits = options.limits;
  for (CommandLimits& limits : s.limits) limits.rate /= c.time.period;
  s.time_constant = options.time_constant * c.time.period;
  s.frequency = 1.0 / c.time.period;
  s.dt = c.time.dt;
  return s;
}

SetPoint ownSetPoint(const Case& c) {
  const Eigen::Vector3d way =
      c.motion->at(c.time.t_start + c.time.period).body.x - c.motion->at(c.time.t_start).body.x;
  const Eigen::Vector3d v = way / c.time.period;
  return {0.0, std::hypot(v.x(), v.z()), std::atan2(-v.z(), v.x())};
}

ControlTrim findTrim(const PhaseMap& map, const ControlOptions& options, double speed, double climb,
                     const ControlTrim& guess) {
  const CommandedFlap flap(map, options, speed, climb, guess);
  const auto f = [&](const VectorXd& y) { return flap.residual(y); };
  const auto unheard = [](const NewtonResult&) {};
  NewtonResult r;
  if (guess.jacobian.size() > 0)
    r = solveTrim(f, flap.unknowns(), searchSettings(options, true), guess.jacobian, unheard);
  constexpr double kMet = 0.1;  // of the targets
  const auto good = [&] { return r.converged && r.residual.targets.norm() < kMet; };
  if (!good()) r = solveTrim(f, flap.unknowns(), searchSettings(options, false), {}, unheard);
  if (!good())
    throw NumericalError("no periodic flight by these commands within their limits (" + r.reason +
                         "; periodic within " +
                         std::to_string(r.residual.periodicity.cwiseAbs().maxCoeff()) +
                         ", mean velocity within " +
                         std::to_string(r.residual.targets.norm() * kVelocity) + " m/s)");
  ControlTrim trim = flap.at(r.unknowns);
  trim.jacobian = r.jacobian;
  trim.residual = r.residual.periodicity.cwiseAbs().maxCoeff();
  const FlapState rates = map.ratesAt(0, trim.start, trim.wingbeat);
  trim.orbit = map.fly(0, trim.start, trim.wingbeat, map.samples(), &rates).states;
  trim.orbit.pop_back();
  return trim;
}

}  // namespace monarch_flight
