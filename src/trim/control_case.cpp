// What a design says of itself: a section of a case file, with where its numbers come from.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "monarch_flight/math/angle.h"
#include "monarch_flight/trim/control_design.h"
#include "run/case/reader.h"
#include "trim/number_text.h"

namespace monarch_flight {
namespace {

using Eigen::Index;

std::string list(const std::vector<double>& values, double unit) {
  std::string text;
  for (double value : values) text += (text.empty() ? "" : ", ") + number(value / unit, 12);
  return "[" + text + "]";
}

/// Eight digits are more than a gain is worth.
std::string row(const Eigen::RowVectorXd& values) {
  constexpr int kDigits = 8;
  std::string text;
  for (double value : values) text += (text.empty() ? "" : ", ") + number(value, kDigits);
  return "[" + text + "]";
}

/// A key with rows of numbers, in a section that stands at `indent`.
void rows(std::ostream& out, const std::string& indent, const std::string& key,
          const Eigen::MatrixXd& m) {
  out << indent << "  " << key << ":\n";
  for (Index i = 0; i < m.rows(); ++i) out << indent << "    - " << row(m.row(i)) << '\n';
}

std::string multiplierText(const std::vector<std::complex<double>>& all) {
  std::string text;
  for (const auto& value : all) {
    if (value.imag() < 0.0 || std::abs(value) < 0.01) continue;  // pairs once
    text += (text.empty() ? "" : ", ") + number(value.real(), 3);
    if (value.imag() > 0.0) text += " +- " + number(value.imag(), 3) + "i";
  }
  return text;
}

void gainRows(std::ostream& out, const FeedbackGains& gains, const std::string& indent) {
  out << indent << "# Rows: sample by sample, in each the inputs.\n" << indent << "gains:\n";
  rows(out, indent, "state", gains.state);
  rows(out, indent, "filter", gains.filter);
  rows(out, indent, "integral", gains.integral);
}

void lateralSection(std::ostream& out, const LateralSettings& lateral) {
  out << "    lateral:\n      inputs: " << namesOf(lateral.gains.inputs)
      << "\n      # A turn without side-slip, per rad a flap: commands, and the states of each "
         "sample.\n"
      << "      turn:\n        most_deg: " << number(lateral.turn / kDegree, 8)
      << "\n        commands: " << row(lateral.turn_commands) << '\n';
  rows(out, "      ", "states", lateral.turn_states);
  if (!lateral.commands.isZero(0.0) || !lateral.states.isZero(0.0)) {
    out << "      # The same of the flight straight on, of wings that differ.\n      straight:\n"
        << "        commands: " << row(lateral.commands) << '\n';
    rows(out, "      ", "states", lateral.states);
  }
  gainRows(out, lateral.gains, "      ");
}

void provenance(std::ostream& out, const Case& c, const ControlDesign& d) {
  const ControlOptions& o = d.options;
  const char* indent = "    # ";
  out << indent
      << "status: computed by monarch trim control:=true (docs/guidance.md) from the case "
      << c.name << ", in quasi-steady air\n"
      << indent << "at " << std::lround(c.time.stepsPerFlap()) << " steps a flap, filters of "
      << number(o.time_constant, 4) << " flaps. Weights: state " << number(o.state_weight, 3)
      << ", integral " << number(o.integral_weight, 3) << ", input " << number(o.input_weight, 3)
      << ".\n"
      << indent << "Trims: " << d.settings.table.commands().rows()
      << ", largest change over a flap " << number(d.residual, 2) << " (scaled).\n"
      << indent << "Floquet multipliers a flap (those above 0.01), without control: "
      << multiplierText(d.in_plane.open_loop) << ";\n"
      << indent << "with it: " << multiplierText(d.in_plane.closed_loop) << " (largest "
      << number(std::abs(d.in_plane.closed_loop.front()), 4) << ").\n";
  if (d.lateral)
    out << indent << "Lateral, without control (1: the heading and the integrals): "
        << multiplierText(d.lateral->open_loop) << ";\n"
        << indent << "with it: " << multiplierText(d.lateral->closed_loop) << " (largest "
        << number(std::abs(d.lateral->closed_loop.front()), 4) << ").\n";
  if (o.own_gains) out << indent << "The gains are those of the case's own motion.\n";
  if (o.own_orbit)
    out << indent << "The reference at the set point is the case's own motion without commands;\n"
        << indent << "the table is moved with it.\n";
}

void wingbeat(std::ostream& out, const ControlOptions& o, bool lateral) {
  out << "guidance:\n  type: controller\n"
      << "  # Of the commands' filters [flaps]; the gains below belong to it.\n"
      << "  time_constant: " << number(o.time_constant, 8) << "\n  limits:\n";
  const auto used = [&](std::size_t i) {
    const auto in = [i](const std::vector<std::size_t>& inputs) {
      return std::find(inputs.begin(), inputs.end(), i) != inputs.end();
    };
    return in(o.inputs) || (lateral && in(o.lateral_inputs));
  };
  for (std::size_t i = 0; i < kCommands; ++i)
    out << "    " << kCommandTable[i].name << ": ["
        << (used(i) ? number(o.limits[i].low, 8) + ", " + number(o.limits[i].high, 8) : "0, 0")
        << "]\n";
  out << "  rates:\n";
  for (std::size_t i = 0; i < kCommands; ++i)
    out << "    " << kCommandTable[i].name << ": " << number(o.limits[i].rate, 8) << "\n";
}

}  // namespace

std::string guidanceSection(const Case& c, const ControlDesign& d) {
  const ControllerSettings& s = d.settings;
  std::ostringstream out;
  wingbeat(out, d.options, s.lateral.has_value());
  out << "  controller:\n";
  provenance(out, c, d);
  out << "    samples: " << s.samples << "\n    inputs: " << namesOf(s.gains.inputs)
      << "\n    # Of the filters that the gains belong to [flaps].\n    time_constant: "
      << number(s.time_constant, 8);
  std::vector<double> flaps, speeds, climbs;
  for (const SetPoint& point : s.set_points) {
    flaps.push_back(point.flap);
    speeds.push_back(point.speed);
    climbs.push_back(point.climb);
  }
  out << "\n    # Mean velocity over ground from these flaps on.\n    set_points:\n      flaps: "
      << list(flaps, 1.0) << "\n      speeds: " << list(speeds, 1.0)
      << "\n      climbs_deg: " << list(climbs, kDegree)
      << "\n    # Of the set point [m/s a flap].\n    slew: " << number(s.slew, 8)
      << "\n    lost:\n      pitch_deg: " << number(s.lost_pitch / kDegree, 8)
      << "\n      flaps: " << number(s.lost_flaps, 8)
      << "\n    # Rows: speed by speed, in each the climbs; of states the samples of a flap.\n"
      << "    table:\n      speeds: " << list(s.table.speeds(), 1.0)
      << "\n      climbs_deg: " << list(s.table.climbs(), kDegree) << '\n';
  rows(out, "    ", "commands", s.table.commands());
  rows(out, "    ", "states", s.table.states());
  gainRows(out, s.gains, "    ");
  if (s.lateral) lateralSection(out, *s.lateral);
  return out.str();
}

}  // namespace monarch_flight
