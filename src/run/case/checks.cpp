#include <algorithm>
#include <cmath>
#include <sstream>

#include "monarch_flight/fluid/grid.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/wing_speeds.h"
#include "run/case/parts.h"

namespace monarch_flight::case_file {
namespace {

/// Start value of one coordinate: explicit where given, completed from the motion; none when
/// neither.
std::optional<StartValue> completed(const std::optional<double>& q, const std::optional<double>& qd,
                                    const Coordinate& prescribed) {
  if (!q && !qd) return std::nullopt;
  return StartValue{q.value_or(prescribed.q), qd.value_or(prescribed.qd)};
}

std::optional<double> component(const std::optional<Eigen::Vector3d>& v, int i) {
  return v ? std::optional<double>((*v)[i]) : std::nullopt;
}

/// A component that is not free may only repeat what the motion prescribes.
void checkPrescribedComponents(const char* key, const std::optional<Eigen::Vector3d>& given,
                               const Eigen::Vector3d& prescribed, const FreeCoordinates& free,
                               Faults& faults) {
  if (!given) return;
  const bool is_free[3] = {free[kX], free[kY], free[kZ]};
  for (int i = 0; i < 3; ++i) {
    if (is_free[i] || std::abs((*given)[i] - prescribed[i]) <= 1e-12) continue;
    std::ostringstream text;
    text << "initial/" << key << '[' << i << "] = " << (*given)[i]
         << ": this coordinate is not free: must be " << prescribed[i]
         << " as the motion has it; free it or change motion/body/" << key;
    faults.add(text.str());
  }
}

constexpr std::pair<const char*, FreeCoordinate> kBodyKeys[] = {
    {"x", kX}, {"y", kY}, {"z", kZ}, {"roll", kRoll}, {"pitch", kPitch}, {"yaw", kYaw}};

}  // namespace

void checkFree(const Case& c, Faults& faults) {
  const FreeCoordinates& f = c.free;
  if (c.insect.bare_wing) {
    for (const auto& [name, i] : kBodyKeys) {
      if (!f[i]) continue;
      faults.add(
          std::string("free/") + name +
          " = true: must be false: a bare wing has no body to move; only wing_pitch may be free");
    }
  }
  if (!f[kThetaR]) return;
  for (Side side : c.sides()) {
    const Appendage& plate = c.insect.wings[side].plate;
    if (plate.J(1, 1) > 0.0) continue;
    std::ostringstream text;
    text << "insect/" << (side == Side::kRight ? "wing" : "left_wing") << "/mass = " << plate.m
         << " kg: must be > 0 kg when free/wing_pitch is "
         << "true; give the wing's mass or set free/wing_pitch false";
    faults.add(text.str());
  }
}

void checkMotion(const Case& c, const CaseMotion& motion, Faults& faults) {
  if (motion.is_wing_table && !c.insect.bare_wing) {
    faults.add(
        "motion/kind = 'wing': must be body for a butterfly; or choose insect/kind bare_wing");
  }
  if (motion.is_wing_table && c.insect.beta != 0.0) {
    faults.add(
        "insect/beta = " + exactText(c.insect.beta) +
        " rad: must be 0 with motion/kind wing: the table holds the wing's own axes; set it to 0");
  }
  if (!motion.is_table || c.time.steps == 0) return;
  const double end = c.time.time(c.time.steps);
  const double rounding = 1e-9 * (motion.t_end - motion.t_begin);
  if (c.time.t_start >= motion.t_begin - rounding && end <= motion.t_end + rounding) return;
  std::ostringstream text;
  text.precision(9);
  text << "motion: the table reaches from " << motion.t_begin << " to " << motion.t_end
       << " s: must cover the run from " << c.time.t_start << " to " << end
       << " s; give a longer table, or change time/t_start or the run's length";
  faults.add(text.str());
}

StartValues startValues(const Case& c, const InitialValues& initial, const PrescribedMotion& motion,
                        Faults& faults) {
  const PrescribedState at_start = motion.at(c.time.t_start);
  const BodyState& body = at_start.body;
  checkPrescribedComponents("position", initial.position, body.x, c.free, faults);
  checkPrescribedComponents("velocity", initial.velocity, body.v, c.free, faults);
  const auto needsFree = [&](const char* key, const std::optional<double>& value, bool is_free,
                             const char* free_key) {
    if (!value || is_free) return;
    faults.add(std::string("initial/") + key + " = " + exactText(*value) + ": free/" + free_key +
               " is false: must be none; free the coordinate or change the motion");
  };
  needsFree("theta_B", initial.theta_B, c.free[kPitch], "pitch");
  needsFree("theta_B_dot", initial.theta_B_dot, c.free[kPitch], "pitch");
  needsFree("roll", initial.roll, c.free[kRoll], "roll");
  needsFree("roll_dot", initial.roll_dot, c.free[kRoll], "roll");
  needsFree("yaw", initial.yaw, c.free[kYaw], "yaw");
  needsFree("yaw_dot", initial.yaw_dot, c.free[kYaw], "yaw");
  needsFree("theta_R", initial.theta_R, c.free[kThetaR], "wing_pitch");
  needsFree("theta_R_dot", initial.theta_R_dot, c.free[kThetaR], "wing_pitch");
  if (!c.mirrored) {
    needsFree("theta_L", initial.theta_L, c.free[kThetaL], "wing_pitch");
    needsFree("theta_L_dot", initial.theta_L_dot, c.free[kThetaL], "wing_pitch");
  }

  StartValues start;
  const auto along = [&](int i) {
    return completed(component(initial.position, i), component(initial.velocity, i),
                     {body.x[i], body.v[i], body.a[i]});
  };
  if (c.free[kX]) start.x = along(0);
  if (c.free[kY]) start.y = along(1);
  if (c.free[kZ]) start.z = along(2);
  if (c.free[kPitch]) start.pitch = completed(initial.theta_B, initial.theta_B_dot, body.pitch);
  // The motion of a butterfly only pitches.
  if (c.free[kRoll]) start.roll = completed(initial.roll, initial.roll_dot, {});
  if (c.free[kYaw]) start.yaw = completed(initial.yaw, initial.yaw_dot, {});
  if (c.free[kThetaR]) {
    start.theta_R =
        completed(initial.theta_R, initial.theta_R_dot, at_start.angles.wings.right.theta);
  }
  if (c.free[kThetaL] && (initial.theta_L || initial.theta_L_dot)) {
    start.theta_L =
        completed(initial.theta_L, initial.theta_L_dot, at_start.angles.wings.left.theta);
  }
  return start;
}

void checkGrid(const Case& c, Faults& faults) {
  if (c.fluid != FluidKind::kNavierStokes) return;
  try {
    for (Side side : c.sides()) makeGrid(c.insect.wings[side].planform, c.grid);
  } catch (const InputError& e) {
    faults.add(e.what());
  }
  const double speed = peakWingSpeeds(c).outline;
  double chord = c.insect.wings.right.planform.meanChord();
  for (Side side : c.sides()) chord = std::min(chord, c.insect.wings[side].planform.meanChord());
  const double cell = chord / c.grid.cells_per_chord;
  const double courant = speed * c.time.dt / cell;
  if (courant <= c.grid.courant_limit) return;
  const double longest = c.grid.courant_limit * cell / speed;
  std::ostringstream text;
  text << (c.time.period > 0.0 ? "time/steps_per_flap" : "time/dt") << ": dt = " << c.time.dt
       << " s gives a Courant number of " << courant << " (peak speed of the wing " << speed
       << " m/s, cell " << cell << " m): must be <= grid/courant_limit = " << c.grid.courant_limit
       << "; ";
  if (c.time.period > 0.0) {
    text << "take steps_per_flap >= " << std::ceil(c.time.period / longest);
  } else {
    text << "take dt <= " << longest << " s";
  }
  faults.add(text.str());
}

}  // namespace monarch_flight::case_file
