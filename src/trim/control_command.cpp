// `monarch trim control:=true`.
#include <cmath>
#include <ostream>

#include "monarch_flight/math/angle.h"
#include "monarch_flight/run/output_file.h"
#include "monarch_flight/trim/command.h"
#include "monarch_flight/trim/controlled_flight.h"
#include "trim/case_edit.h"

namespace monarch_flight {
namespace {

void printDesign(std::ostream& out, const ControlDesign& design) {
  const auto line = [&](const char* what, const std::vector<std::complex<double>>& all) {
    out << "  " << what;
    for (const auto& value : all) {
      if (std::abs(value) < 0.01 || value.imag() < 0.0) continue;
      out << "  " << value.real();
      if (value.imag() > 0.0) out << " +- " << value.imag() << "i";
      out << " (" << std::abs(value) << ")";
    }
    out << '\n';
  };
  out << "Floquet multipliers a flap (those above 0.01):\n";
  line("uncontrolled         ", design.in_plane.open_loop);
  line("controlled           ", design.in_plane.closed_loop);
  if (!design.lateral) return;
  line("lateral, uncontrolled", design.lateral->open_loop);
  line("lateral, controlled  ", design.lateral->closed_loop);
}

void printControlled(std::ostream& out, const ControlDesign& design,
                     const ControlledFlight& flight) {
  out << "flap  climb deg  speed m/s  theta_B mean, lowest, highest deg  commands\n";
  int number = 0;
  for (const ControlledFlap& flap : flight.flaps) {
    char line[160];
    std::snprintf(line, sizeof line, "%4d  %9.2f  %9.3f  %12.2f %8.2f %8.2f  ", ++number,
                  flap.climb / kDegree, flap.speed, flap.theta_B_mean / kDegree,
                  flap.theta_B_low / kDegree, flap.theta_B_high / kDegree);
    out << line;
    std::vector<std::size_t> inputs = design.settings.gains.inputs;
    if (const auto& lateral = design.settings.lateral) {
      inputs.insert(inputs.end(), lateral->gains.inputs.begin(), lateral->gains.inputs.end());
      std::snprintf(line, sizeof line, "turn %.2f deg, roll %.2f to %.2f deg", flap.turn / kDegree,
                    flap.roll_low / kDegree, flap.roll_high / kDegree);
      out << line;
    }
    for (std::size_t input : inputs) {
      const CommandInfo& info = kCommandTable[input];
      std::snprintf(line, sizeof line, "  %s %.4f to %.4f %s", info.name,
                    flap.command_low.*info.value, flap.command_high.*info.value, info.unit);
      out << line;
    }
    out << (flap.limited ? "  limited\n" : "\n");
  }
  if (flight.lost) out << "the controller is lost\n";
  if (!flight.complete) out << "the flight ended: " << flight.failure << '\n';
}

}  // namespace

int runControl(TrimCommand command, const std::string& config_dir, std::ostream& out) {
  requireNew(command.out, {""});
  ControlOptions& options = *command.control;
  options.limits = ControlOptions::usualLimits(config_dir);
  CaseOverrides own = command.overrides;  // the case keeps its own air
  own.erase("fluid");
  const Case written = loadCase(command.case_name, own, config_dir);
  const Case c = loadCase(command.case_name, command.overrides, config_dir);
  options.own_orbit =
      command.orbit.empty() ? written.fluid == FluidKind::kNavierStokes : command.orbit == "own";
  options.own_gains = command.gains == "own";
  const ControlDesign design = designController(c, options, out);
  printDesign(out, design);
  if (!command.out.empty()) {
    CaseEdit edit(written.resolved_yaml);
    edit.remove({"guidance"});
    edit.set({"name"}, written.name + "_controlled");
    writeWhole(command.out,
               "# Made by monarch trim control:=true (docs/guidance.md) from the case " +
                   written.name + ".\n" + edit.text() + guidanceSection(c, design));
    out << "case: " << command.out << std::endl;
  }
  if (command.fly == 0) return 0;
  ControlledStart start;
  start.flaps = command.fly;
  const ControlledFlight flight =
      flyControlled(c, wingbeatSettings(c, options), design.settings, start);
  printControlled(out, design, flight);
  return flight.complete && !flight.lost ? 0 : 1;
}

}  // namespace monarch_flight
