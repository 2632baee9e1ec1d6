// What a trim says of its result: a table for people and a case file.
#include <cmath>
#include <map>
#include <ostream>
#include <sstream>

#include "monarch_flight/math/angle.h"
#include "monarch_flight/trim/trim.h"
#include "trim/case_edit.h"
#include "trim/number_text.h"

namespace monarch_flight {
namespace {

std::string targetText(const TrimTarget& target, const std::vector<Flap>& flaps) {
  const bool angle = target.kind != TrimTarget::kSpeed;
  const double unit = angle ? kDegree : 1.0;
  std::string reached;
  for (const Flap& flap : flaps) reached += ' ' + number(target.of(flap) / unit, 4);
  return std::string(TrimTarget::name(target.kind)) + " " + number(target.value / unit, 4) +
         (angle ? " deg" : " m/s") + " (reached" + reached + ")";
}

std::string targetsText(const TrimOptions& options, const TrimResult& result) {
  std::string text;
  for (const TrimTarget& target : options.targets) {
    text += (text.empty() ? "" : ", ") + targetText(target, result.flaps);
  }
  return text.empty() ? "nothing" : text;
}

double residual(const TrimResult& result) {
  return result.newton.residual.periodicity.cwiseAbs().maxCoeff();
}

std::string airText(const FlapMap& map) {
  const Case& c = map.baseCase();
  if (c.fluid == FluidKind::kQuasiSteady) return "quasi-steady air";
  if (c.fluid == FluidKind::kPlugin) return "air by " + fluidName(c);
  return "Navier-Stokes air, grid " + c.grid.level + ", run-in of " + std::to_string(map.runIn()) +
         " flaps";
}

void printModes(std::ostream& out, const FlapMap& map, const TrimResult& result) {
  out << "Floquet multipliers a flap, and their modes (";
  for (int i : map.active()) out << ' ' << kStateNames[i];
  out << " ), in units of";
  for (int i : map.active()) out << ' ' << trimScales()(i) << ' ' << kStateUnits[i];
  out << ":\n";
  for (const FloquetMode& mode : result.floquet) {
    out << "  |" << number(std::abs(mode.multiplier), 4) << "|  "
        << number(mode.multiplier.real(), 4) << (mode.multiplier.imag() < 0 ? " - " : " + ")
        << number(std::abs(mode.multiplier.imag()), 4) << "i :";
    for (const auto& component : mode.mode) {
      out << "  " << number(std::abs(component), 2) << '@'
          << std::lround(std::arg(component) / kDegree);
    }
    out << '\n';
  }
}

}  // namespace

void printTrim(std::ostream& out, const FlapMap& map, const TrimOptions& options,
               const TrimResult& result) {
  const Flap& flap = result.flaps.front();
  out << "trim of " << map.baseCase().name << " (" << airText(map) << "): " << result.newton.reason
      << "\n";
  out << "  residual        " << number(residual(result), 3)
      << " (largest change over a flap, scaled)\n";
  out << "  cost            " << result.newton.iterations << " iterations, "
      << result.newton.evaluations << " evaluations, " << result.flaps_flown << " flaps, "
      << number(result.wall_s, 3) << " s\n";
  for (int i : map.active()) {
    out << "  " << kStateNames[i] << std::string(16 - std::string(kStateNames[i]).size(), ' ')
        << number(result.point.state(i), 8) << ' ' << kStateUnits[i] << '\n';
  }
  for (std::size_t i = 0; i < map.parameters().size(); ++i) {
    const TrimParameter& p = map.parameters()[i];
    out << "  " << p.name << std::string(16 - p.name.size(), ' ')
        << number(result.point.parameters(static_cast<Eigen::Index>(i)), 8) << ' ' << p.unit
        << " (range " << number(p.low) << " to " << number(p.high) << ")\n";
  }
  out << "  fitted to       " << targetsText(options, result) << '\n';
  out << "  climb angle     " << number(flap.climb / kDegree, 4) << " deg\n  speed           "
      << number(flap.speed, 4) << " m/s\n  body pitch      mean "
      << number(flap.theta_B_mean / kDegree, 4) << ", swing "
      << number(flap.theta_B_swing / kDegree, 4) << " deg\n  wing pitch      swing "
      << number(flap.theta_R_swing / kDegree, 4) << " deg\n";
  if (map.baseCase().free[kYaw])
    out << "  turn            " << number(flap.turn / kDegree, 4) << " deg a flap\n";
  printModes(out, map, result);
}

std::string trimmedCase(const FlapMap& map, const TrimOptions& options, const TrimResult& result,
                        int run_in_steps, int flaps) {
  CaseEdit edit(map.caseText(result.point, run_in_steps, flaps));
  edit.set({"name"}, map.baseCase().name + "_trimmed");
  edit.set({"description"}, "Periodic flight found by trim from the case " + map.baseCase().name);
  const std::string how =
      "fitted by trim to " +
      (options.horizon > 1 ? std::to_string(options.horizon) + " free flaps" : "periodic flight") +
      " in " + airText(map) + "; residual " + number(residual(result), 3) + " (scaled) over a flap";
  std::map<std::string, std::string> comments;
  for (const TrimParameter& p : map.parameters()) {
    std::string path;
    for (const std::string& key : p.path) {
      if (!std::isdigit(static_cast<unsigned char>(key[0])))
        path += (path.empty() ? "" : "/") + key;
    }
    comments[path] = "status: fitted by trim in " + airText(map) + " within " + number(p.low) +
                     " to " + number(p.high) + " " + p.unit + ",\nto " +
                     targetsText(options, result);
  }
  const Case& c = map.baseCase();
  if (c.free[kX] || c.free[kZ]) comments["motion/body"] = "status: " + how;
  if (c.free[kPitch]) comments["motion/theta_B_deg"] = "Run-in and start; status: " + how;
  if (c.free[kThetaR]) comments["motion/theta_R_deg"] = "Run-in and start; status: " + how;
  comments["coupling/prescribed_steps"] = "The run-in: these steps fly the periodic motion above.";
  std::ostringstream head;
  head << "# Made by monarch trim (docs/trim.md) from the case " << c.name
       << ". Numbers without a comment are that case's.\n# Largest Floquet multiplier "
       << number(std::abs(result.floquet.front().multiplier), 4) << " a flap.\n";
  return head.str() + edit.text(comments);
}

}  // namespace monarch_flight
