// Periodic flights under constant commands.
#include <algorithm>
#include <cmath>

#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/trim/control_design.h"
#include "monarch_flight/trim/trim.h"
#include "trim/control_scales.h"

namespace monarch_flight {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kVelocity = 0.01;  // a miss of the mean velocity by it counts 1 [m/s]
constexpr double kTurn = 0.01;      // the same of the heading over a flap [rad]

/// What is sought: states that move, and commands.
struct Unknowns {
  std::vector<int> states;
  std::vector<std::size_t> inputs;
  bool symmetric;
};

Unknowns unknownsOf(const Case& c, const ControlOptions& options, bool symmetric) {
  Unknowns u{{0, 1, 2, 3}, options.inputs, symmetric};
  if (c.free[kThetaR]) u.states.insert(u.states.end(), {4, 5});
  if (symmetric) return u;
  u.states.insert(u.states.end(), {6, 7, 8, 9});
  if (c.free[kThetaL]) u.states.insert(u.states.end(), {10, 11});
  u.inputs.insert(u.inputs.end(), options.lateral_inputs.begin(), options.lateral_inputs.end());
  return u;
}

/// Between dimensionless unknowns and trims.
class CommandedFlap {
 public:
  CommandedFlap(const PhaseMap& map, const Unknowns& unknowns, double speed, double climb,
                const ControlTrim& guess)
      : map_(map),
        sought_(unknowns),
        inputs_(sought_.inputs),
        point_(guess),
        n_(static_cast<Index>(sought_.states.size())),
        aside_inputs_(std::count_if(inputs_.begin(), inputs_.end(),
                                    [](std::size_t i) { return i >= kAlikeCommands; })) {
    wanted_ = SetPoint{0.0, speed, climb}.velocity();
    point_.speed = speed;
    point_.climb = climb;
    point_.symmetric = sought_.symmetric;
  }

  VectorXd unknowns() const {
    VectorXd y(n_ + static_cast<Index>(inputs_.size()));
    y.head(n_) = scaledStates(point_.start);
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      y(n_ + static_cast<Index>(i)) =
          point_.wingbeat.command.*kCommandTable[inputs_[i]].value / commandScale(inputs_[i]);
    return y;
  }

  ControlTrim at(const VectorXd& y) const {
    ControlTrim trim = point_;
    for (Index i = 0; i < n_; ++i) {
      const int k = sought_.states[static_cast<std::size_t>(i)];
      trim.start(k) = y(i) * trimScales()(k);
    }
    if (sought_.symmetric) trim.start.tail<2>() = trim.start.segment<2>(4);
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
    r.periodicity = scaledStates(flight.states.back() - trim.start);
    const Index aside = std::min<Index>(2, aside_inputs_);
    r.targets.resize(2 + aside);
    r.targets.head<2>() = (flight.velocity - wanted_) / kVelocity;
    if (aside > 0) r.targets(2) = flight.sideways.turn / kTurn;
    if (aside > 1) r.targets(3) = flight.sideways.mean_velocity / kVelocity;
    return r;
  }

 private:
  VectorXd scaledStates(const FlapState& state) const {
    VectorXd part(n_);
    for (Index i = 0; i < n_; ++i) {
      const int k = sought_.states[static_cast<std::size_t>(i)];
      part(i) = state(k) / trimScales()(k);
    }
    return part;
  }

  const PhaseMap& map_;
  const Unknowns& sought_;
  const std::vector<std::size_t>& inputs_;
  ControlTrim point_;
  Index n_, aside_inputs_;
  Eigen::Vector2d wanted_;
};

NewtonSettings searchSettings(const ControlOptions& options, const Unknowns& unknowns, bool known) {
  NewtonSettings s;
  s.tolerance = 1e-5;
  s.step_tolerance = 1e-4;
  s.max_iterations = unknowns.symmetric ? 15 : 40;
  s.max_step = 1.0;
  s.damping = 0.0;
  s.broyden = known;
  const auto m = static_cast<Index>(unknowns.inputs.size());
  s.lower.resize(m);
  s.upper.resize(m);
  for (Index i = 0; i < m; ++i) {
    const std::size_t k = unknowns.inputs[static_cast<std::size_t>(i)];
    s.lower(i) = options.limits[k].low / commandScale(k);
    s.upper(i) = options.limits[k].high / commandScale(k);
  }
  return s;
}

}  // namespace

double commandScale(std::size_t command) {
  switch (command) {
    case kAmplitudeCommand:
    case kFrequencyCommand:
    case kDifferentialAmplitude:
      return 0.1;
    case kDeviationMeanCommand:
    case kDifferentialDeviation:
      return 5.0 * kDegree;
    case kFlappingMeanCommand:
    case kRestAngleCommand:
    case kDifferentialFlapping:
    case kDifferentialRestAngle:
      return 10.0 * kDegree;
    case kAbdomenMeanCommand:
      return 15.0 * kDegree;
    default:
      return 0.5;  // kAbdomenAmplitudeCommand
  }
}

FlapState with(FlapState state, const VectorXd& components) {
  for (Index i = 0; i < components.size(); ++i) state(i) = components(i);
  state.tail<2>() = state.segment<2>(4);  // both wings alike
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

bool fliesStraight(const PhaseMap& map) {
  const FlapState start = map.prescribedState(0);
  const PhaseFlight flight = map.fly(0, start, {}, 1);
  if (!flight.complete)
    throw NumericalError("the flight from the case's motion fails: " + flight.failure);
  const FlapState& end = flight.states.back();
  return flight.sideways.turn == 0.0 && end.segment<4>(kInPlaneStates).isZero(0.0);
}

ControlTrim findTrim(const PhaseMap& map, const ControlOptions& options, double speed, double climb,
                     const ControlTrim& guess) {
  const Unknowns unknowns = unknownsOf(map.baseCase(), options, guess.symmetric);
  const CommandedFlap flap(map, unknowns, speed, climb, guess);
  const auto f = [&](const VectorXd& y) { return flap.residual(y); };
  const auto unheard = [](const NewtonResult&) {};
  NewtonResult r;
  if (guess.jacobian.cols() == flap.unknowns().size())  // else of a flight of the other kind
    r = solveTrim(f, flap.unknowns(), searchSettings(options, unknowns, true), guess.jacobian,
                  unheard);
  constexpr double kMet = 0.1;  // of the targets
  const auto good = [&] { return r.converged && r.residual.targets.norm() < kMet; };
  if (!good())
    r = solveTrim(f, flap.unknowns(), searchSettings(options, unknowns, false), {}, unheard);
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
  const PhaseFlight orbit = map.fly(0, trim.start, trim.wingbeat, map.samples(), &rates);
  trim.orbit = orbit.states;
  trim.headings = orbit.headings;
  trim.orbit.pop_back();
  trim.headings.pop_back();
  double mean = 0.0;
  for (double heading : trim.headings) mean += heading / map.samples();
  for (double& heading : trim.headings) heading -= mean;
  return trim;
}

}  // namespace monarch_flight
