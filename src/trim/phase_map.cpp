#include "monarch_flight/trim/phase_map.h"

#include <algorithm>
#include <cmath>

#include "monarch_flight/insect/heading.h"
#include "monarch_flight/insect/start_motion.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/federation.h"
#include "trim/led_flight.h"

namespace monarch_flight {
namespace {

constexpr double kUnlimited = 1e6;  // of a command, and of its rate

/// Sets filters and commands by their names, and leaves the rest.
class Preset : public StateVisitor {
 public:
  explicit Preset(const WingbeatStart& from) : from_(from) {}
  bool loading() const override { return true; }
  bool has(const char*) const override { return true; }
  void numbers(const char* name, double* values, std::size_t) override {
    const std::string text = name;
    for (std::size_t i = 0; i < kCommands; ++i) {
      const double target = from_.command.*kCommandTable[i].value;
      const Coordinate& c = from_.filters[i];
      if (text == std::string("command_") + kCommandTable[i].name) values[0] = target;
      if (text != filterName(i)) continue;
      values[0] = target;
      values[1] = c.q;
      values[2] = c.qd;
      values[3] = c.qdd;
    }
  }
  void bytes(const char*, std::vector<char>&) override {}
  static std::string filterName(std::size_t i) {
    return std::string("filter_") + kCommandTable[i].name;
  }

 private:
  const WingbeatStart& from_;
};

/// The wingbeat as from a start in the middle of a flight.
class StartedWingbeat : public Guidance {
 public:
  StartedWingbeat(const Case& c, double time_constant, const WingbeatStart& from)
      : inner_(c.motion, c.wind, settings(c, time_constant), c.time.t_start, nullptr),
        from_(from) {}
  PrescribedState start(double t) override {
    const PrescribedState state = inner_.start(t);  // only the air looks at it, which has no memory
    Preset preset(from_);
    inner_.memory(preset);
    return state;
  }
  PrescribedState next(const GuidanceInput& input) override { return inner_.next(input); }
  GuidanceReport report() const override { return inner_.report(); }
  void memory(StateVisitor& state) override { inner_.memory(state); }

 private:
  static WingbeatSettings settings(const Case& c, double time_constant) {
    WingbeatSettings s;
    s.limits.fill({-kUnlimited, kUnlimited, kUnlimited});
    s.limits[kFrequencyCommand].low = s.limits[kAmplitudeCommand].low = -0.5;
    s.limits[kDifferentialAmplitude] = {-0.49, 0.49, kUnlimited};  // both wings beat
    s.time_constant = time_constant;
    s.frequency = 1.0 / c.time.period;
    s.dt = c.time.dt;
    return s;
  }

  WingbeatGuidance inner_;
  WingbeatStart from_;
};

/// Keeps every level, with its phase.
class LevelRecorder : public StepSink {
 public:
  void onStep(const CommittedStep& step) override {
    const BodyState& body = step.interface.body;
    states.push_back(flapState(step.interface));
    rates.push_back(flapRates(step.interface));
    places.emplace_back(body.x.x(), body.x.z());
    headings.push_back(headingMotion(body).yaw.q);
    times.push_back(step.t);
    phases.push_back(step.guidance.phase);
  }
  void onReset() override {}
  void onEnd(const std::string&) override {}
  /// Between two levels by Hermite's cubic; returns the time since the start.
  double at(double phase, FlapState& s, FlapState& a, Eigen::Vector2d& place) const;
  /// Heading against that of the start at a time since then, and its and the side velocity's means.
  SideMotion sideways(double elapsed) const;

  std::vector<FlapState> states, rates;
  std::vector<Eigen::Vector2d> places;
  std::vector<double> headings;
  std::vector<double> times, phases;
};

double LevelRecorder::at(double phase, FlapState& s, FlapState& a, Eigen::Vector2d& place) const {
  std::size_t k = 0;
  while (k + 2 < phases.size() && phases[k + 1] < phase) ++k;
  const double dt = times[k + 1] - times[k];
  const double p = (phase - phases[k]) / (phases[k + 1] - phases[k]);
  const double h0 = (1.0 + 2.0 * p) * (1.0 - p) * (1.0 - p), h1 = p * p * (3.0 - 2.0 * p);
  const double g0 = p * (1.0 - p) * (1.0 - p) * dt, g1 = p * p * (p - 1.0) * dt;
  s = h0 * states[k] + h1 * states[k + 1] + g0 * rates[k] + g1 * rates[k + 1];
  a = (1.0 - p) * rates[k] + p * rates[k + 1];
  const auto v = [&](std::size_t i) { return Eigen::Vector2d(states[i].head<2>()); };
  place = h0 * places[k] + h1 * places[k + 1] + g0 * v(k) + g1 * v(k + 1);
  return times[k] + p * dt - times.front();
}

SideMotion LevelRecorder::sideways(double elapsed) const {
  SideMotion m;
  double heading = 0.0, side = states[0](6), t = 0.0;
  for (std::size_t k = 0; k + 1 < times.size() && t < elapsed; ++k) {
    const double dt = times[k + 1] - times[k], part = std::min(1.0, (elapsed - t) / dt);
    const double turned = part * std::remainder(headings[k + 1] - headings[k], 2.0 * M_PI);
    const double next = side + part * (states[k + 1](6) - side);
    m.mean_heading += part * dt * (heading + 0.5 * turned);
    m.mean_velocity += part * dt * 0.5 * (side + next);
    heading += turned;
    side = next;
    t += part * dt;
  }
  m.turn = heading;
  m.mean_heading /= elapsed;
  m.mean_velocity /= elapsed;
  return m;
}

}  // namespace

PhaseMap::PhaseMap(const Case& c, int samples, double time_constant)
    : case_(c), samples_(samples), time_constant_(time_constant) {
  std::vector<std::string> faults;
  const double steps = c.time.stepsPerFlap();
  if (!(c.time.period > 0.0))
    faults.push_back("motion/frequency: must be > 0 for a flap to have phases; give one");
  else if (samples < 1 || std::abs(std::remainder(steps, samples)) > 1e-6)
    faults.push_back("samples = " + std::to_string(samples) + ": must divide the " +
                     std::to_string(std::lround(steps)) + " steps of a flap; 10 is usual");
  if (c.fluid != FluidKind::kQuasiSteady)
    faults.push_back(
        "fluid/solver: must be quasi_steady, an air without memory, for a flight to begin at any "
        "phase; give fluid:=quasi_steady");
  if (!faults.empty()) throw InputError(faults);
  case_.guidance = {};
  case_.wind = std::make_shared<SteadyWind>();
  case_.output.surface_every = case_.output.flow_every = case_.output.fields_every = 0;
  case_.coupling.prescribed_steps = 0;
}

FlapState PhaseMap::prescribedState(int phase) const {
  return flapState(case_.motion->at(timeOf(phase)).interface());
}

PhaseFlight PhaseMap::fly(int phase, const FlapState& s, const WingbeatStart& wingbeat,
                          int intervals, const FlapState* rates) const {
  const double flaps = static_cast<double>(intervals) / samples_;
  const double slowest =
      1.0 + std::min({0.0, wingbeat.filters[kFrequencyCommand].q, wingbeat.command.frequency});
  const bool even = slowest == 1.0 && wingbeat.filters[kFrequencyCommand].qd == 0.0;
  const auto steps =
      std::ceil(flaps * case_.time.stepsPerFlap() / slowest - 1e-6) + (even ? 0.0 : 2.0);
  LevelRecorder levels;
  const RunResult result =
      flyFrom(phase, s, wingbeat, static_cast<std::uint32_t>(steps), rates, levels);
  PhaseFlight flight;
  flight.complete = result.complete;
  flight.failure = result.failure;
  if (!result.complete) return flight;
  double elapsed = 0.0;
  Eigen::Vector2d place;
  for (int k = 0; k <= intervals; ++k) {
    FlapState state, rate;
    elapsed =
        levels.at(levels.phases.front() + static_cast<double>(k) / samples_, state, rate, place);
    flight.states.push_back(state);
    flight.rates.push_back(rate);
    flight.headings.push_back(k == 0 ? 0.0 : levels.sideways(elapsed).turn);
  }
  flight.velocity = (place - levels.places.front()) / elapsed;
  flight.sideways = levels.sideways(elapsed);
  flight.wingbeat = wingbeat;
  Preset preset(wingbeat);
  for (std::size_t i = 0; i < kCommands; ++i) {
    CommandFilter filter(time_constant_, kUnlimited);
    filter.memory(preset, Preset::filterName(i).c_str());
    filter.advance(wingbeat.command.*kCommandTable[i].value, elapsed);
    flight.wingbeat.filters[i] = filter.value();
  }
  return flight;
}

/// Without `rates` the first step is flown at constant acceleration.
RunResult PhaseMap::flyFrom(int phase, const FlapState& s, const WingbeatStart& wingbeat,
                            std::uint32_t steps, const FlapState* rates, StepSink& sink) const {
  Case c = case_;
  c.time.t_start = timeOf(phase);
  c.time.steps = steps;
  const FlapState a = rates ? *rates : FlapState::Zero();
  c.motion = std::make_shared<StartMotion>(
      case_.motion, startOf(c.free, Eigen::Vector3d::Zero(), s, a), c.time.t_start);
  c.coupling.accelerations_known = rates != nullptr;
  return flyLed(c, std::make_unique<StartedWingbeat>(c, time_constant_, wingbeat), {&sink});
}

FlapState PhaseMap::ratesAt(int phase, const FlapState& state,
                            const WingbeatStart& wingbeat) const {
  constexpr int kPasses = 3;
  FlapState rates = FlapState::Zero();
  for (int pass = 0; pass < kPasses; ++pass) {
    LevelRecorder levels;
    if (!flyFrom(phase, state, wingbeat, 2, &rates, levels).complete) break;
    rates = 2.0 * levels.rates[1] - levels.rates[2];  // extrapolated to the start
  }
  return rates;
}

}  // namespace monarch_flight
