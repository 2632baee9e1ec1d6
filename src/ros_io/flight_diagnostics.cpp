// What a step says on /diagnostics.
#include <cstdio>
#include <string>

#include "monarch_flight/ros_io/flight_messages.h"

namespace monarch_flight {
namespace {

using diagnostic_msgs::DiagnosticStatus;

diagnostic_msgs::KeyValue entry(const std::string& key, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  diagnostic_msgs::KeyValue out;
  out.key = key;
  out.value = text;
  return out;
}

diagnostic_msgs::KeyValue count(const char* key, std::uint64_t value) {
  diagnostic_msgs::KeyValue out;
  out.key = key;
  out.value = std::to_string(value);
  return out;
}

// Late and repeated messages happen where a node was slow; the others come from strangers.
DiagnosticStatus messages(const IgnoredMessages& ignored) {
  const bool strangers = ignored.foreign + ignored.malformed + ignored.forged > 0;
  DiagnosticStatus out;
  out.name = "messages";
  out.hardware_id = "monarch_flight";
  out.level = strangers ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
  out.message =
      strangers ? "messages of strangers were refused" : "only the nodes of the run speak";
  out.values = {count("late", ignored.late), count("repeated", ignored.repeated),
                count("foreign", ignored.foreign), count("malformed", ignored.malformed),
                count("forged", ignored.forged)};
  return out;
}

DiagnosticStatus guidance(const GuidanceReport& report) {
  DiagnosticStatus out;
  out.name = "guidance";
  out.hardware_id = "monarch_flight";
  const bool told = report.lost || report.clipped + report.refused > 0;
  out.level = told ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
  out.message = report.lost          ? "guidance has given up"
                : report.refused > 0 ? "commands were refused: not finite"
                : report.clipped > 0 ? "commands were cut to their bounds"
                                     : "as commanded";
  out.values = {entry("phase [flaps]", report.phase), count("clipped", report.clipped),
                count("refused", report.refused)};
  for (const CommandInfo& info : kCommandTable)
    out.values.push_back(entry(info.name, report.applied.*info.value));
  return out;
}

}  // namespace

diagnostic_msgs::DiagnosticArray FlightMessages::diagnostics(const CommittedStep& step,
                                                             const ros::Time& stamp) const {
  DiagnosticStatus coupling, solvers;
  coupling.name = "coupling";
  solvers.name = "solvers";
  coupling.hardware_id = solvers.hardware_id = "monarch_flight";
  coupling.level = step.retried() ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
  coupling.message = step.retried()    ? "converged at the second attempt"
                     : step.prescribed ? "prescribed step"
                                       : "converged";
  coupling.values = {entry("step", step.step),
                     entry("t [s]", step.t),
                     entry("sub-iterations", static_cast<double>(step.iterations.size())),
                     entry("evaluations of the air", step.fluid_evaluations),
                     entry("added-mass ratio", step.added_mass_ratio),
                     entry("work of the air, fluid's side [J]", step.work_fluid),
                     entry("work of the air, structure's side [J]", step.work_structure)};
  if (!step.iterations.empty()) {
    const IterationRecord& last = step.iterations.back();
    for (std::size_t i = 0; i < kCoordinates; ++i) {
      if (!case_.free[i]) continue;
      const std::string unit = kCoordinateTable[i].translation ? "/c" : " [rad]";
      coupling.values.push_back(
          entry("residual " + std::string(kCoordinateTable[i].name) + unit, last.residual[i]));
    }
    coupling.values.push_back(entry("load residual", last.load_residual));
    coupling.values.push_back(entry("relaxation", last.relaxation));
  }
  const bool fast = step.fluid.courant > 0.9 * case_.grid.courant_limit;
  solvers.level = fast ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
  solvers.message = fast ? "Courant number close to its limit" : "running";
  solvers.values = {
      entry("Courant number", step.fluid.courant), entry("divergence", step.fluid.divergence),
      entry("fluid [s]", step.wall_s[0]),          entry("flight [s]", step.wall_s[1]),
      entry("wing [s]", step.wall_s[2]),           entry("guidance [s]", step.wall_s[3]),
      entry("exchange [s]", step.exchange_s)};
  diagnostic_msgs::DiagnosticArray out;
  out.header.stamp = stamp;
  out.status = {coupling, solvers, messages(step.ignored), guidance(step.guidance)};
  for (DiagnosticStatus& status : out.status) status.name = names_.diagnosticPrefix() + status.name;
  return out;
}

}  // namespace monarch_flight
