#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "run/case/parts.h"

namespace monarch_flight::case_file {
namespace {

/// Takes what `read` returns unless reading it was a fault; so bounds can be checked all together.
template <typename Value, typename Read>
void keep(Value& value, const Faults& faults, const Read& read) {
  const std::size_t before = faults.count();
  const Value found = read();
  if (faults.count() == before) value = found;
}

constexpr double kRounding = 1e-6;  // of a time, over the time step
constexpr double kRemainder =
    1e-3;  // of a step: the rounding of a length that is given in decimals

/// Whole steps in so many; what is left of them is kept.
double wholeSteps(double steps, TimeGrid& time) {
  const double whole = std::floor(steps + kRemainder);
  time.remainder = std::isfinite(steps) && steps - whole > kRemainder ? steps - whole : 0.0;
  return whole;
}

}  // namespace

CaseWind readFluid(Section section, bool mirrored, Case& c, Faults& faults) {
  const std::string solver =
      section.choiceOrPlugin("solver", {"navier_stokes", "quasi_steady"}, "my_package/MyFluid");
  c.fluid = isPluginName(solver)       ? FluidKind::kPlugin
            : solver == "quasi_steady" ? FluidKind::kQuasiSteady
                                       : FluidKind::kNavierStokes;
  if (c.fluid == FluidKind::kPlugin) c.fluid_plugin = {solver, section.anything("parameters")};
  section.take("parameters");  // of a case of a plugin that is flown otherwise
  const std::string variant = section.choice("blade_element", {"sane_dickinson", "whitney_wood"});
  c.blade_element = variant == "whitney_wood" ? BladeElementVariant::kWhitneyWood
                                              : BladeElementVariant::kSaneDickinson;
  c.air.rho = section.number("density", {Bound::kPositive, "kg/m3", "air at 15 C has 1.225"});
  c.air.mu = section.number("viscosity", {Bound::kPositive, "Pa s", "air at 15 C has 1.8e-5"});
  c.gravity = section.number("gravity", {Bound::kNonNegative, "m/s2", "9.81, or 0 for none"});
  const CaseWind wind = readWind(section, mirrored, faults);
  section.finish();
  return wind;
}

void readGrid(Section section, Case& c, Faults& faults) {
  const std::string level = section.choice("level", {"preview", "standard", "fine", "custom"});
  if (level.empty()) return;
  GridSettings& g = c.grid;
  g = GridSettings::preset(level);
  const bool custom = level == "custom";  // then every key must be there
  const auto number = [&](const char* key, double& value, const char* unit) {
    if (custom || section.has(key)) {
      keep(value, faults, [&] { return section.number(key, {Bound::kAny, unit, ""}); });
    } else {
      section.put(key, exactText(value));
    }
  };
  number("cells_per_chord", g.cells_per_chord, "");
  number("first_cell", g.first_cell, "mean chords");
  number("growth_plane", g.growth_plane, "");
  number("growth_normal", g.growth_normal, "");
  number("far_field", g.far_field, "mean chords");
  number("margin", g.margin, "mean chords");
  if (custom || section.has("outer")) {
    const std::string outer = section.choice("outer", {"rest", "open"});
    if (!outer.empty()) g.outer = outer;
  } else {
    section.put("outer", g.outer);
  }
  number("courant_limit", g.courant_limit, "");
  section.finish();
  faults.add(g.problems());
}

FreeCoordinates readFree(Section section, bool mirrored) {
  FreeCoordinates free;
  free[kX] = section.flag("x");
  free[kZ] = section.flag("z");
  free[kPitch] = section.flag("pitch");
  // Who is free in the plane is free out of it, too, where nothing keeps both sides alike.
  const bool flies = !mirrored && free[kX] && free[kZ] && free[kPitch];
  for (const auto& [name, i] : {std::pair{"y", kY}, {"roll", kRoll}, {"yaw", kYaw}}) {
    free[i] = section.has(name) ? section.flag(name) : flies;
    section.put(name, std::string(free[i] ? "true" : "false"));
  }
  free[kThetaR] = section.flag("wing_pitch");
  free[kThetaL] = free[kThetaR] && !mirrored;
  section.finish();
  return free;
}

void readTime(Section section, double frequency, Case& c) {
  c.time.t_start = section.number("t_start", {Bound::kAny, "s", "0 is usual"});
  c.time.period = frequency > 0.0 ? 1.0 / frequency : 0.0;
  double steps = 0.0;
  const bool by_step = section.has("dt") || section.has("duration");
  const bool by_flap = section.has("steps_per_flap") || section.has("flaps");
  if (by_step && by_flap) {
    for (const char* key : {"dt", "duration", "steps_per_flap", "flaps"}) section.take(key);
    section.fault(
        "dt",
        ": give either steps_per_flap and flaps, or dt and duration, not both (flaps:= and "
        "steps_per_flap:= on the command line need a case given by flaps)");
  } else if (by_step) {
    c.time.dt = section.number("dt", {Bound::kPositive, "s", "give the time step"});
    const double duration =
        section.number("duration", {Bound::kPositive, "s", "give the length of the run"});
    steps = wholeSteps(duration / c.time.dt, c.time);
  } else {
    const int per_flap = section.integer("steps_per_flap", "500 is usual");
    const double flaps = section.number("flaps", {Bound::kPositive, "", "2 is usual"});
    if (per_flap < 1) {
      section.fault("steps_per_flap",
                    " = " + std::to_string(per_flap) + ": must be >= 1; 500 is usual");
    } else if (section.clean() && !(frequency > 0.0)) {
      section.fault(
          "steps_per_flap",
          ": this motion has no flapping period (motion/frequency is 0); give dt and duration");
    } else if (section.clean()) {
      c.time.dt = c.time.period / per_flap;
      steps = wholeSteps(flaps * per_flap, c.time);
    }
  }
  section.finish();
  if (!section.clean()) return;
  if (!(steps >= 1.0) || steps > std::numeric_limits<std::uint32_t>::max()) {
    section.fault(by_step ? "duration" : "flaps",
                  " amounts to " + exactText(steps + c.time.remainder) +
                      " steps: must be 1 to 4294967295; change the length or the step");
    return;
  }
  c.time.steps = static_cast<std::uint32_t>(steps);
  // t = t_start + step * dt keeps six digits of dt; 2^32 steps from 0 do.
  const double latest = std::max(std::abs(c.time.t_start), std::abs(c.time.time(c.time.steps)));
  if (latest * std::numeric_limits<double>::epsilon() <= kRounding * c.time.dt) return;
  section.fault("t_start",
                " = " + exactText(c.time.t_start) + " s: the run reaches to " + exactText(latest) +
                    " s, where a step of " + exactText(c.time.dt) +
                    " s is lost in rounding: must end before " +
                    exactText(kRounding * c.time.dt / std::numeric_limits<double>::epsilon()) +
                    " s; start earlier or take longer steps");
}

void readCoupling(Section section, double mean_chord, Case& c, Faults& faults) {
  CouplingSettings& s = c.coupling;
  const std::string relaxation =
      section.choice("relaxation", {"constant", "aitken", "iqn_ils", "added_mass"});
  s.relaxation = relaxation == "constant"  ? Relaxation::kConstant
                 : relaxation == "aitken"  ? Relaxation::kAitken
                 : relaxation == "iqn_ils" ? Relaxation::kIqnIls
                                           : Relaxation::kAddedMass;
  const auto number = [&](const char* key, double& value) {
    keep(value, faults, [&] { return section.number(key, {}); });
  };
  const auto integer = [&](const char* key, int& value, const char* remedy) {
    keep(value, faults, [&] { return section.integer(key, remedy); });
  };
  number("omega_initial", s.omega_initial);
  number("omega_min", s.omega_min);
  number("omega_max", s.omega_max);
  integer("reuse_steps", s.reuse_steps, "4 is usual");
  integer("operator_every", s.operator_every, "250 is usual");
  number("tolerance", s.tolerance);
  number("load_tolerance", s.load_tolerance);
  integer("max_sub_iterations", s.max_sub_iterations, "60 is usual");
  integer("prescribed_steps", s.prescribed_steps, "the published value is 10");
  const YAML::Node length = section.take("length_scale");
  if (length.IsDefined() && length.IsScalar() && length.Scalar() == "mean_chord") {
    section.put("length_scale", std::string("mean_chord"));
    s.length_scale = mean_chord;
  } else {
    keep(s.length_scale, faults, [&] {
      return section.number("length_scale", {Bound::kAny, "m", "or mean_chord"});
    });
  }
  section.finish();
  faults.add(s.problems());
}

void readOutput(Section section, Case& c) {
  c.output.record = section.flag("record");
  for (auto [key, value] : {std::pair{"surface_every", &c.output.surface_every},
                            std::pair{"flow_every", &c.output.flow_every},
                            std::pair{"fields_every", &c.output.fields_every}}) {
    *value = section.integer(key, "steps between pictures, 0: never");
    if (*value < 0) {
      section.fault(key, " = " + std::to_string(*value) + ": must be >= 0; 0 writes no pictures");
    }
  }
  c.output.flow_points = section.integer("flow_points", "points of a picture of the flow");
  if (c.output.flow_points < 1000 || c.output.flow_points > 1000000) {
    section.fault("flow_points", " = " + std::to_string(c.output.flow_points) +
                                     ": must be in [1000, 1000000]; 40000 is usual, and "
                                     "flow_every: 0 makes no pictures of the flow");
  }
  if (c.output.fields_every > 0 && c.fluid == FluidKind::kQuasiSteady) {
    section.fault("fields_every", " = " + std::to_string(c.output.fields_every) +
                                      ": quasi_steady has no flow field; must be 0, or choose "
                                      "fluid/solver navier_stokes");
  }
  c.output.checkpoint_every =
      section.integer("checkpoint_every", "steps between checkpoints, 0: none");
  if (c.output.checkpoint_every < 0) {
    section.fault("checkpoint_every", " = " + std::to_string(c.output.checkpoint_every) +
                                          ": must be >= 0; 0 makes no checkpoints");
  }
  section.finish();
}

}  // namespace monarch_flight::case_file
