#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/trim/command.h"

namespace monarch_flight {
namespace {

const char kKnown[] =
    "case, fluid, grid, wings, steps_per_flap, fit, climb, speed, pitch, swing, horizon, start, "
    "run_in, "
    "iterations, tolerance, difference, threads, jacobian, out, fly, control, samples, inputs, "
    "lateral_inputs, turn, time_constant, orbit, gains, speeds, climbs";

/// All key:=value arguments, with what is wrong in them.
class Arguments {
 public:
  explicit Arguments(const std::vector<std::string>& arguments) {
    for (const std::string& argument : arguments) {
      const std::size_t mark = argument.find(":=");
      if (mark == std::string::npos || mark == 0) {
        faults.push_back("'" + argument + "': must be key:=value; known keys are " + kKnown);
      } else if (!values_.emplace(argument.substr(0, mark), argument.substr(mark + 2)).second) {
        faults.push_back("'" + argument + "': this key is given twice; give it once");
      }
    }
  }

  bool has(const std::string& key) { return taken_.insert(key), values_.count(key) > 0; }
  std::string text(const std::string& key) { return has(key) ? values_[key] : ""; }

  double number(const std::string& key, double low, double high, double otherwise) {
    if (!has(key)) return otherwise;
    return number(key, values_[key], low, high);
  }

  double number(const std::string& what, const std::string& text, double low, double high) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (!text.empty() && *end == '\0' && value >= low && value <= high) return value;
    std::ostringstream fault;
    fault << what << ":=" << text << ": must be a number from " << low << " to " << high
          << "; correct it";
    faults.push_back(fault.str());
    return low;
  }

  int whole(const std::string& key, int low, int high, int otherwise) {
    const double value = number(key, low, high, otherwise);
    if (value != std::floor(value)) {
      faults.push_back(key + ":=" + values_[key] + ": must be a whole number; correct it");
    }
    return static_cast<int>(value);
  }

  void finish() {
    for (const auto& [key, value] : values_) {
      if (taken_.count(key) == 0) {
        faults.push_back(key + ":=" + value + ": unknown key; known keys are " + kKnown);
      }
    }
    if (!faults.empty()) throw InputError(faults);
  }

  std::vector<std::string> faults;

 private:
  std::map<std::string, std::string> values_;
  std::set<std::string> taken_;
};

std::vector<std::string> split(const std::string& text, char mark) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, mark);) parts.push_back(part);
  return parts;
}

/// name:low:high, comma separated.
std::vector<TrimParameter> fitted(Arguments& arguments) {
  std::vector<TrimParameter> chosen;
  std::string names;
  for (const TrimParameter& p : trimParameters()) names += (names.empty() ? "" : ", ") + p.name;
  for (const std::string& item : split(arguments.text("fit"), ',')) {
    const auto parts = split(item, ':');
    const auto& all = trimParameters();
    const auto found = std::find_if(all.begin(), all.end(), [&](const TrimParameter& p) {
      return !parts.empty() && p.name == parts[0];
    });
    if (found == all.end() || parts.size() != 3) {
      arguments.faults.push_back("fit:=" + item + ": must be name:low:high with name one of " +
                                 names + "; as kappa:1e-4:2e-4");
      continue;
    }
    TrimParameter p = *found;
    p.low = arguments.number("fit " + p.name, parts[1], -1.0, 1.0);
    p.high = arguments.number("fit " + p.name, parts[2], -1.0, 1.0);
    if (!(p.low < p.high)) {
      arguments.faults.push_back("fit:=" + item + ": low must be below high; exchange them");
    }
    for (const TrimParameter& other : chosen) {
      if (other.name == p.name) {
        arguments.faults.push_back("fit:=" + item + ": " + p.name +
                                   " is given twice; give it one range");
      }
    }
    chosen.push_back(p);
  }
  return chosen;
}

std::vector<TrimTarget> targets(Arguments& arguments) {
  std::vector<TrimTarget> all;
  const auto add = [&](TrimTarget::Kind kind, double unit, double tolerance, double low,
                       double high) {
    const char* key = TrimTarget::name(kind);
    if (!arguments.has(key)) return;
    all.push_back({kind, arguments.number(key, low, high, 0.0) * unit, tolerance});
  };
  add(TrimTarget::kClimb, kDegree, 2.0 * kDegree, -90.0, 90.0);
  add(TrimTarget::kSpeed, 1.0, 0.1, 0.0, 100.0);
  add(TrimTarget::kPitch, kDegree, 2.0 * kDegree, -180.0, 180.0);
  add(TrimTarget::kSwing, kDegree, 3.0 * kDegree, 0.0, 360.0);
  return all;
}

void readStart(Arguments& arguments, TrimOptions& options) {
  if (!arguments.has("start")) return;
  const auto parts = split(arguments.text("start"), ',');
  if (parts.size() != kInPlaneStates && parts.size() != kFlapStates) {
    arguments.faults.push_back("start:=" + arguments.text("start") +
                               ": must be six numbers u,w,theta_B,theta_B_dot,theta_R,theta_R_dot, "
                               "with independent wings six more, v,roll,roll_dot,yaw_dot,theta_L,"
                               "theta_L_dot [m/s, rad, rad/s]; correct it");
    return;
  }
  FlapState state = FlapState::Zero();
  for (std::size_t i = 0; i < parts.size(); ++i)
    state(static_cast<int>(i)) = arguments.number("start", parts[i], -1e4, 1e4);
  if (parts.size() == kInPlaneStates) state.tail<2>() = state.segment<2>(4);
  options.start = state;
}

std::vector<double> numberList(Arguments& arguments, const char* key, double low, double high,
                               double unit) {
  std::vector<double> values;
  if (!arguments.has(key)) return values;
  for (const std::string& part : split(arguments.text(key), ','))
    values.push_back(unit * arguments.number(key, part, low, high));
  return values;
}

/// Commands from `first` on and before `last`.
std::vector<std::size_t> inputList(Arguments& arguments, const char* key, std::size_t first,
                                   std::size_t last) {
  std::vector<std::size_t> inputs;
  std::string names;
  for (std::size_t i = first; i < last; ++i)
    names += (names.empty() ? "" : ", ") + std::string(kCommandTable[i].name);
  for (const std::string& name : split(arguments.text(key), ',')) {
    std::size_t i = first;
    while (i < last && name != kCommandTable[i].name) ++i;
    const bool again = std::find(inputs.begin(), inputs.end(), i) != inputs.end();
    if (i == last || again) {
      arguments.faults.push_back(std::string(key) + ":=" + name + ": must be different ones of " +
                                 names + "; with commas between them");
    }
    inputs.push_back(i);
  }
  return inputs;
}

/// Keys of a controller; without control:=true they are faults.
std::optional<ControlOptions> control(Arguments& arguments) {
  const std::string wanted = arguments.text("control");
  if (arguments.has("control") && wanted != "true" && wanted != "false")
    arguments.faults.push_back("control:=" + wanted + ": must be true or false; correct it");
  if (wanted != "true") return std::nullopt;
  ControlOptions options;
  options.samples = arguments.whole("samples", 1, 1000, options.samples);
  if (arguments.has("inputs")) options.inputs = inputList(arguments, "inputs", 0, kAlikeCommands);
  if (arguments.has("lateral_inputs"))
    options.lateral_inputs = inputList(arguments, "lateral_inputs", kAlikeCommands, kCommands);
  if (arguments.has("turn")) options.turn = kDegree * arguments.number("turn", 1e-3, 360.0, 5.0);
  options.lateral_asked = arguments.has("lateral_inputs") || arguments.has("turn");
  options.time_constant = arguments.number("time_constant", 1e-3, 10.0, options.time_constant);
  if (arguments.has("speed")) options.speed = arguments.number("speed", 1e-3, 100.0, 1.0);
  if (arguments.has("climb")) options.climb = kDegree * arguments.number("climb", -89.0, 89.0, 0.0);
  options.speeds = numberList(arguments, "speeds", 1e-3, 100.0, 1.0);
  options.climbs = numberList(arguments, "climbs", -89.0, 89.0, kDegree);
  for (const char* key : {"fit", "pitch", "swing", "horizon", "start", "run_in", "jacobian"}) {
    if (arguments.has(key))
      arguments.faults.push_back(std::string(key) +
                                 ": is for a trim; leave it out with control:=true");
  }
  return options;
}

}  // namespace

TrimCommand trimCommand(const std::vector<std::string>& given) {
  Arguments arguments(given);
  TrimCommand command;
  if (arguments.has("case")) command.case_name = arguments.text("case");
  for (const char* key : {"fluid", "grid", "wings", "steps_per_flap"}) {
    if (arguments.has(key)) command.overrides[key] = arguments.text(key);
  }
  if (command.overrides.count("fluid") == 0) command.overrides["fluid"] = "quasi_steady";
  const bool quick = command.overrides["fluid"] == "quasi_steady";
  TrimOptions& options = command.options;
  options.parameters = fitted(arguments);
  options.targets = targets(arguments);
  readStart(arguments, options);
  options.run_in = arguments.whole("run_in", 0, 100, quick ? 0 : 1);
  options.horizon = arguments.whole("horizon", 1, 100, 1);
  if (options.horizon > 1 && options.targets.empty()) {
    arguments.faults.push_back("horizon:=" + arguments.text("horizon") +
                               ": needs targets to meet; give climb, speed, pitch or swing");
  }
  NewtonSettings& newton = options.newton;
  newton.max_iterations = arguments.whole("iterations", 0, 1000, quick ? 40 : 8);
  newton.tolerance = arguments.number("tolerance", 1e-12, 1.0, quick ? 1e-6 : 0.02);
  newton.difference = arguments.number("difference", 1e-9, 1.0, quick ? 1e-3 : 0.2);
  newton.threads = arguments.whole("threads", 1, 64, 1);
  newton.central = quick;
  newton.broyden = !quick;
  if (!quick) {
    newton.max_step = 0.8;
    newton.max_halvings = 4;
    newton.damping = 0.1;
    newton.weight = options.targets.empty() ? 0.0 : 5.0;
    newton.step_tolerance = 0.05;
  }
  if (options.horizon > 1) {  // each flap is sought, not that the first comes back to its start
    newton.weight = 0.5;
    newton.max_step = 0.2;  // grows from flap to flap
    newton.max_halvings = 6;
    newton.least_squares = true;
  }
  command.jacobian_file = arguments.text("jacobian");
  command.out = arguments.text("out");
  command.fly = arguments.whole("fly", 0, 1000, 0);
  command.control = control(arguments);
  for (auto [key, value] :
       {std::pair{"orbit", &command.orbit}, std::pair{"gains", &command.gains}}) {
    if (!command.control || !arguments.has(key)) continue;
    *value = arguments.text(key);
    if (*value != "own" && *value != "trim")
      arguments.faults.push_back(std::string(key) + ":=" + *value +
                                 ": must be own or trim; choose one");
  }
  arguments.finish();
  return command;
}

}  // namespace monarch_flight
