#include "run/case/controller.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "monarch_flight/math/angle.h"

namespace monarch_flight::case_file {
namespace {

using Eigen::Index;

/// The commands that a law may have as its inputs.
struct Choice {
  std::size_t first, last;
};
constexpr Choice kAlike = {0, kAlikeCommands}, kDifferential = {kAlikeCommands, kCommands};

std::string known(const Choice& choice) {
  std::string names;
  for (std::size_t i = choice.first; i < choice.last; ++i)
    names += (names.empty() ? "" : ", ") + std::string(kCommandTable[i].name);
  return names;
}

/// "amplitude, deviation_mean".
std::vector<std::size_t> readInputs(Section& section, const Choice& choice, const Faults& faults) {
  std::vector<std::size_t> inputs;
  const std::size_t before = faults.count();
  const std::string given = section.text("inputs");
  const bool read = section.has("inputs") && faults.count() == before;
  if (read && given.find_first_not_of(", ") == std::string::npos) {
    section.fault("inputs",
                  " = '" + given + "': must name a command; give some of " + known(choice));
    return inputs;
  }
  std::istringstream names(given);
  for (std::string name; std::getline(names, name, ',');) {
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    const auto last = kCommandTable.begin() + static_cast<std::ptrdiff_t>(choice.last);
    const auto found =
        std::find_if(kCommandTable.begin() + static_cast<std::ptrdiff_t>(choice.first), last,
                     [&](const CommandInfo& info) { return info.name == name; });
    if (found == last) {
      section.fault("inputs", " = '" + name + "': must be commands of " + known(choice) +
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

Eigen::VectorXd vector(Section& section, const std::string& key) {
  const std::vector<double> values = section.numbers(key, "");
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
}

TrimTable readTable(Section section, std::size_t inputs, std::size_t states) {
  std::vector<double> speeds = section.numbers("speeds", "m/s");
  std::vector<double> climbs = inRadians(section.numbers("climbs_deg", "deg"));
  Eigen::MatrixXd commands = matrix(section, "commands", inputs);
  Eigen::MatrixXd orbits = matrix(section, "states", states);
  section.finish();
  return {std::move(speeds), std::move(climbs), std::move(commands), std::move(orbits)};
}

void readGains(Section section, int states, FeedbackGains& gains) {
  gains.state = matrix(section, "state", static_cast<std::size_t>(states));
  gains.filter = matrix(section, "filter", 3 * gains.inputs.size());
  gains.integral = matrix(section, "integral", 2);
  section.finish();
}

std::optional<LateralSettings> readLateral(Section section, int samples, int states,
                                           Faults& faults) {
  LateralSettings lateral;
  const std::size_t before = faults.count();
  lateral.gains.inputs = readInputs(section, kDifferential, faults);
  if (faults.count() > before) return std::nullopt;
  Section turn = section.section("turn");
  lateral.turn = kDegree * turn.number("most_deg", {Bound::kPositive, "deg a flap", "5 is usual"});
  lateral.turn_commands = vector(turn, "commands");
  lateral.turn_states = matrix(turn, "states", static_cast<std::size_t>(states));
  turn.finish();
  lateral.commands = Eigen::VectorXd::Zero(lateral.gains.size());
  lateral.states = Eigen::MatrixXd::Zero(samples, states);
  if (section.has("straight")) {
    Section straight = section.section("straight");
    lateral.commands = vector(straight, "commands");
    lateral.states = matrix(straight, "states", static_cast<std::size_t>(states));
    straight.finish();
  }
  readGains(section.section("gains"), states, lateral.gains);
  section.finish();
  return lateral;
}

std::vector<SetPoint> readSetPoints(Section section) {
  const std::vector<double> flaps = section.numbers("flaps", "");
  const std::vector<double> speeds = section.numbers("speeds", "m/s");
  const std::vector<double> climbs = inRadians(section.numbers("climbs_deg", "deg"));
  const bool turns = section.has("headings_deg");
  const std::vector<double> headings =
      turns ? inRadians(section.numbers("headings_deg", "deg")) : std::vector<double>();
  section.finish();
  std::vector<SetPoint> points;
  if (section.clean() && turns && headings.size() != flaps.size()) {
    section.fault("headings_deg", " has " + std::to_string(headings.size()) +
                                      " values: must be as many as flaps has, " +
                                      std::to_string(flaps.size()) +
                                      "; give one for each set point, or leave the key out");
  } else if (section.clean() && (speeds.size() != flaps.size() || climbs.size() != flaps.size())) {
    section.fault("flaps", " has " + std::to_string(flaps.size()) + " values, speeds " +
                               std::to_string(speeds.size()) + ", climbs_deg " +
                               std::to_string(climbs.size()) +
                               ": must be as many; give one of each for a set point");
  } else if (section.clean()) {
    for (std::size_t i = 0; i < flaps.size(); ++i)
      points.push_back({flaps[i], speeds[i], climbs[i],
                        turns ? std::optional<double>(headings[i]) : std::nullopt});
  }
  return points;
}

/// Unknown keys and inputs decide what all other keys mean, so they are told first and alone.
bool namesAreKnown(Section& section, const Faults& faults) {
  const std::size_t before = faults.count();
  for (const char* key : {"samples", "inputs", "time_constant", "set_points", "slew", "lost",
                          "table", "gains", "lateral"})
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
  if (s.lateral && (c.mirrored || !c.free[kY] || !c.free[kRoll] || !c.free[kYaw]))
    section.fault("lateral",
                  ": needs wings: independent, and free/y, free/roll and free/yaw true; give them, "
                  "or leave the section out");
  for (const SetPoint& point : s.set_points) {
    if (!point.heading || s.lateral) continue;
    section.fault("set_points/headings_deg",
                  ": needs the section lateral to be followed; let monarch trim write it "
                  "(control:=true with wings:=independent), or leave the key out");
    break;
  }
}

}  // namespace

std::optional<ControllerSettings> readController(Section section, const Case& c, Faults& faults) {
  const std::size_t before = faults.count();
  if (!namesAreKnown(section, faults)) return std::nullopt;
  ControllerSettings s;
  s.samples = section.integer("samples", "10 is usual; the gains belong to it");
  const std::size_t before_inputs = faults.count();
  s.gains.inputs = readInputs(section, kAlike, faults);
  if (faults.count() > before_inputs) return std::nullopt;
  s.time_constant = section.number(
      "time_constant", {Bound::kPositive, "flaps", "it is that for which the gains were made"});
  s.wing_pitch = c.free[kThetaR];
  s.first_step = static_cast<std::uint32_t>(std::max(c.coupling.prescribed_steps, 0));
  s.set_points = readSetPoints(section.section("set_points"));
  s.slew = section.number("slew", {Bound::kPositive, "m/s a flap", "0.1 is usual"});
  Section lost = section.section("lost");
  s.lost_pitch = kDegree * lost.number("pitch_deg", {Bound::kPositive, "deg", "75 is usual"});
  s.lost_flaps = lost.number("flaps", {Bound::kPositive, "flaps", "10 is usual"});
  lost.finish();
  s.table = readTable(section.section("table"), s.gains.inputs.size(),
                      static_cast<std::size_t>(s.states()));
  readGains(section.section("gains"), s.states(), s.gains);
  if (section.has("lateral"))
    s.lateral = readLateral(section.section("lateral"), s.samples, s.lateralStates(), faults);
  if (faults.count() > before) return std::nullopt;
  checkAgainst(c, s, section);
  faults.add(s.problems());
  if (faults.count() > before) return std::nullopt;
  return s;
}

}  // namespace monarch_flight::case_file
