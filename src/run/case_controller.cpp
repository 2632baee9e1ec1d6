#include "run/case_controller.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace monarch_flight {
namespace {

using Eigen::Index;
constexpr double kDegree = M_PI / 180.0;

std::string known() {
  std::string names;
  for (std::size_t i = 0; i < kAlikeCommands; ++i)
    names += (names.empty() ? "" : ", ") + std::string(kCommandTable[i].name);
  return names;
}

/// "amplitude, deviation_mean".
std::vector<std::size_t> readInputs(Section& section, const Faults& faults) {
  std::vector<std::size_t> inputs;
  const std::size_t before = faults.count();
  const std::string given = section.text("inputs");
  const bool read = section.has("inputs") && faults.count() == before;
  if (read && given.find_first_not_of(", ") == std::string::npos) {
    section.fault("inputs", " = '" + given + "': must name a command; give some of " + known());
    return inputs;
  }
  std::istringstream names(given);
  for (std::string name; std::getline(names, name, ',');) {
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    const auto last = kCommandTable.begin() + kAlikeCommands;
    const auto found = std::find_if(kCommandTable.begin(), last,
                                    [&](const CommandInfo& info) { return info.name == name; });
    if (found == last) {
      section.fault("inputs", " = '" + name + "': must be commands of " + known() +
                                  " with commas between them; correct it");
      continue;
    }
    inputs.push_back(static_cast<std::size_t>(found - kCommandTable.begin()));
  }
  return inputs;
}

Eigen::MatrixXd matrix(Section& section, const std::string& key, std::size_t columns) {
  const std::vector<std::vector<double>> rows = section.rows(key, columns);
  Eigen::MatrixXd m(static_cast<Index>(rows.size()), static_cast<Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < columns; ++k)
      m(static_cast<Index>(i), static_cast<Index>(k)) = rows[i][k];
  return m;
}

std::vector<double> inRadians(std::vector<double> degrees) {
  for (double& value : degrees) value *= kDegree;
  return degrees;
}

TrimTable readTable(Section section, std::size_t inputs, std::size_t states) {
  std::vector<double> speeds = section.numbers("speeds", "m/s");
  std::vector<double> climbs = inRadians(section.numbers("climbs_deg", "deg"));
  Eigen::MatrixXd commands = matrix(section, "commands", inputs);
  Eigen::MatrixXd orbits = matrix(section, "states", states);
  section.finish();
  return {std::move(speeds), std::move(climbs), std::move(commands), std::move(orbits)};
}

void readGains(Section section, std::size_t inputs, ControllerSettings& s) {
  s.state_gain = matrix(section, "state", static_cast<std::size_t>(s.states()));
  s.filter_gain = matrix(section, "filter", 3 * inputs);
  s.integral_gain = matrix(section, "integral", 2);
  section.finish();
}

std::vector<SetPoint> readSetPoints(Section section) {
  const std::vector<double> flaps = section.numbers("flaps", "");
  const std::vector<double> speeds = section.numbers("speeds", "m/s");
  const std::vector<double> climbs = inRadians(section.numbers("climbs_deg", "deg"));
  section.finish();
  std::vector<SetPoint> points;
  if (section.clean() && (speeds.size() != flaps.size() || climbs.size() != flaps.size())) {
    section.fault("flaps", " has " + std::to_string(flaps.size()) + " values, speeds " +
                               std::to_string(speeds.size()) + ", climbs_deg " +
                               std::to_string(climbs.size()) +
                               ": must be as many; give one of each for a set point");
  } else if (section.clean()) {
    for (std::size_t i = 0; i < flaps.size(); ++i)
      points.push_back({flaps[i], speeds[i], climbs[i]});
  }
  return points;
}

/// Unknown keys and inputs decide what all other keys mean, so they are told first and alone.
bool namesAreKnown(Section& section, const Faults& faults) {
  const std::size_t before = faults.count();
  for (const char* key :
       {"samples", "inputs", "time_constant", "set_points", "slew", "lost", "table", "gains"})
    section.take(key);
  section.finish();
  return faults.count() == before;
}

/// What the rest of the case must be for the law to be flown.
void checkAgainst(const Case& c, const ControllerSettings& s, Section& section) {
  const double steps = c.time.stepsPerFlap();
  if (!(steps > 0.0)) {
    section.fault("samples",
                  ": the motion has no flaps to sample; give motion/frequency and "
                  "time/steps_per_flap");
  } else if (s.samples > 0 && std::abs(std::remainder(steps, s.samples)) > 1e-6) {
    section.fault("samples", " = " + std::to_string(s.samples) + ": must divide the " +
                                 std::to_string(std::lround(steps)) +
                                 " steps of a flap; change time/steps_per_flap");
  }
  if (!c.free[kX] || !c.free[kZ] || !c.free[kPitch])
    section.fault("inputs",
                  ": there is no free flight to control: free/x, free/z and free/pitch must be "
                  "true; free them, or take guidance/type motion");
}

}  // namespace

std::optional<ControllerSettings> readController(Section section, const Case& c, Faults& faults) {
  const std::size_t before = faults.count();
  if (!namesAreKnown(section, faults)) return std::nullopt;
  ControllerSettings s;
  s.samples = section.integer("samples", "10 is usual; the gains belong to it");
  const std::size_t before_inputs = faults.count();
  s.inputs = readInputs(section, faults);
  if (faults.count() > before_inputs) return std::nullopt;
  s.time_constant = section.number(
      "time_constant", {Bound::kPositive, "flaps", "it is that for which the gains were made"});
  s.wing_pitch = c.free[kThetaR];
  s.first_step = static_cast<std::uint32_t>(std::max(c.coupling.prescribed_steps, 0));
  const std::size_t m = s.inputs.size();
  s.set_points = readSetPoints(section.section("set_points"));
  s.slew = section.number("slew", {Bound::kPositive, "m/s a flap", "0.1 is usual"});
  Section lost = section.section("lost");
  s.lost_pitch = kDegree * lost.number("pitch_deg", {Bound::kPositive, "deg", "75 is usual"});
  s.lost_flaps = lost.number("flaps", {Bound::kPositive, "flaps", "10 is usual"});
  lost.finish();
  s.table = readTable(section.section("table"), m, static_cast<std::size_t>(s.states()));
  readGains(section.section("gains"), m, s);
  if (faults.count() > before) return std::nullopt;
  checkAgainst(c, s, section);
  faults.add(s.problems());
  if (faults.count() > before) return std::nullopt;
  return s;
}

}  // namespace monarch_flight
