#include <cmath>
#include <filesystem>
#include <sstream>

#include "monarch_flight/guidance/replay_guidance.h"
#include "monarch_flight/math/errors.h"
#include "run/case/controller.h"
#include "run/case/document.h"
#include "run/case/parts.h"

namespace monarch_flight::case_file {
namespace {

constexpr GuidanceKind kKinds[] = {GuidanceKind::kMotion, GuidanceKind::kCommands,
                                   GuidanceKind::kController, GuidanceKind::kNode,
                                   GuidanceKind::kReplay};

std::vector<std::string> kindNames() {
  std::vector<std::string> names;
  for (GuidanceKind kind : kKinds) names.push_back(guidanceName(kind));
  return names;
}

std::string unitOf(const CommandInfo& info) { return info.unit; }

/// Bounds of every command, and the largest change over a flap.
void readLimits(Section& section, double period, bool mirrored, WingbeatSettings& settings) {
  Section limits = section.section("limits");
  Section rates = section.section("rates");
  for (std::size_t i = 0; i < kCommands; ++i) {
    const CommandInfo& info = kCommandTable[i];
    const std::vector<double> range = limits.numbers(info.name, unitOf(info));
    if (range.size() == 2) {
      settings.limits[i].low = range[0];
      settings.limits[i].high = range[1];
    } else if (limits.has(info.name) && limits.take(info.name).IsSequence()) {
      limits.fault(info.name,
                   " has " + std::to_string(range.size()) +
                       " values: must be 2, the lowest and the highest command; give both");
    }
    settings.limits[i].rate =
        rates.number(info.name, {Bound::kPositive, unitOf(info) + " a flap", "1 is usual"}) /
        period;
  }
  if (mirrored) {
    for (Command difference : {kDifferentialAmplitude, kDifferentialFlapping,
                               kDifferentialDeviation, kDifferentialRestAngle})
      settings.limits[difference].low = settings.limits[difference].high = 0.0;
  }
  limits.finish();
  rates.finish();
}

/// The rows of a flight.csv, from `file` or written out; the resolved case holds the rows.
std::shared_ptr<const NumericTable> readReplay(Section& section) {
  const std::vector<std::string>& columns = ReplayGuidance::columns();
  if (!section.has("file")) {
    return std::make_shared<NumericTable>(
        NumericTable{section.pathOf("rows"), columns, section.rows("rows", columns.size())});
  }
  const YAML::Node file = section.take("file");
  if (!file.IsScalar() || section.has("rows")) {
    section.take("rows");
    section.fault("file", ": give either the path of a flight.csv or rows");
    return nullptr;
  }
  const NumericTable table = readCsv(file.Scalar()).select(columns);
  section.put("rows", table.rows);
  return std::make_shared<NumericTable>(table);
}

/// The law, whose gains belong to the filters that it was made with.
std::optional<ControllerSettings> readLaw(Section& section, double time_constant, const Case& c,
                                          Faults& faults) {
  auto law = readController(section.section("controller"), c, faults);
  if (law && std::abs(law->time_constant - time_constant) > 1e-6 * time_constant) {
    section.fault("time_constant", " = " + exactText(time_constant) + " flaps: must be " +
                                       exactText(law->time_constant) +
                                       ", for which the controller's gains were made; or make "
                                       "others (monarch trim control:=true time_constant:=...)");
  }
  return law;
}

}  // namespace

GuidanceSettings readGuidance(Section section, double frequency, const Case& c, Faults& faults) {
  GuidanceSettings settings;
  const std::string kind = section.choiceOrPlugin("type", kindNames(), "my_package/MyGuidance");
  for (GuidanceKind one : kKinds) {
    if (kind == guidanceName(one)) settings.kind = one;
  }
  if (isPluginName(kind)) {
    settings.kind = GuidanceKind::kPlugin;
    settings.plugin = {kind, section.anything("parameters")};
  }
  section.take("parameters");  // of a case of a plugin that is led otherwise
  const double period = frequency > 0.0 ? 1.0 / frequency : 1.0;
  settings.wingbeat.frequency = frequency;
  const double time_constant =
      section.number("time_constant", {Bound::kPositive, "flaps", "0.25 is usual"});
  settings.wingbeat.time_constant = time_constant * period;
  readLimits(section, period, c.mirrored, settings.wingbeat);
  if (settings.kind == GuidanceKind::kReplay) {
    try {
      settings.replay = readReplay(section);
    } catch (const InputError& e) {
      faults.add(e.what());
    }
  } else {
    section.take("file");
    section.take("rows");
  }
  if (settings.kind == GuidanceKind::kController && !section.has("controller")) {
    section.take("controller");
    section.fault("controller",
                  " is missing: this case has no controller; take climb_controlled, or make one "
                  "with monarch trim <case> control:=true out:=<new case>");
  } else if (settings.kind == GuidanceKind::kController) {
    settings.controller = readLaw(section, time_constant, c, faults);
  } else {
    section.take("controller");  // of a controlled case that is flown otherwise
  }
  section.finish();
  return settings;
}

/// Values that a recorded flight cannot have.
void checkReplay(const Case& c, const NumericTable& table, Faults& faults) {
  const auto check = [&](const std::string& name, double low, double high) {
    const std::vector<double> values = table.column(name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] >= low && values[i] <= high) continue;
      faults.add(table.name + ": row " + std::to_string(i + 1) + ", column " + name + " = " +
                 exactText(values[i]) + ": must be " + exactText(low) +
                 (low < high ? " to " + exactText(high) : "") +
                 "; take the flight.csv of a flight with this case");
      return;
    }
  };
  constexpr double kMostCounted = 4294967295.0;
  check("clipped", 0.0, kMostCounted);
  check("refused", 0.0, kMostCounted);
  check("lost", 0.0, 1.0);
  if (c.insect.bare_wing || !c.mirrored) return;
  check("wy", 0.0, 0.0);  // as in kMirrored
  check("way", 0.0, 0.0);
}

void checkGuidance(const Case& c, const CaseMotion& motion, Faults& faults) {
  const GuidanceSettings& g = c.guidance;
  if (g.kind == GuidanceKind::kReplay) {
    if (!g.replay) return;
    const auto& rows = g.replay->rows;
    checkReplay(c, *g.replay, faults);
    if (rows.size() <= c.time.steps) {
      faults.add(g.replay->name + ": has " + std::to_string(rows.size()) +
                 " rows: must have one a level, " + std::to_string(c.time.steps + 1) +
                 "; fly fewer flaps or give the table of a longer flight");
      return;
    }
    for (std::uint32_t i = 0; i <= c.time.steps; ++i) {
      if (std::abs(rows[i][0] - c.time.time(i)) <= 1e-6 * c.time.dt) continue;
      std::ostringstream text;
      text.precision(9);
      text << g.replay->name << ": row " << i + 1 << ", column t = " << rows[i][0] << " s: must be "
           << c.time.time(i) << " s as in this run; take the case and the time "
           << "step of the flight that is flown again";
      faults.add(text.str());
      return;
    }
    return;
  }
  if (g.kind == GuidanceKind::kMotion || g.kind == GuidanceKind::kPlugin) return;
  faults.add(g.wingbeat.problems());
  if (!motion.is_table) return;
  if (c.time.t_start + c.time.period > motion.t_end + 1e-9 * c.time.period) {
    faults.add("motion: the table ends at " + exactText(motion.t_end) +
               " s: must reach over a flap from time/t_start, to " +
               exactText(c.time.t_start + c.time.period) +
               " s, for a wingbeat that is led; give a longer table, or guidance/type motion");
  }
  const CommandLimits& f = g.wingbeat.limits[kFrequencyCommand];
  if (f.low == 0.0 && f.high == 0.0) return;
  faults.add("guidance/limits/frequency = [" + exactText(f.low) + ", " + exactText(f.high) +
             "]: must be [0, 0] with a motion by a table, which has its own clock; set it to that");
}

}  // namespace monarch_flight::case_file

namespace monarch_flight {

std::array<CommandLimits, kCommands> defaultCommandLimits(const std::string& config_dir) {
  const std::string path = config_dir + "/defaults.yaml";
  case_file::Faults faults;
  case_file::Section defaults(case_file::caseFile(path), "", faults);
  case_file::Section section = defaults.section("guidance");
  WingbeatSettings settings;
  case_file::readLimits(section, 1.0, false, settings);
  faults.throwIfAny(path);
  return settings.limits;
}

}  // namespace monarch_flight
