#include <cmath>

#include "monarch_flight/insect/fourier_motion.h"
#include "monarch_flight/insect/table_motion.h"
#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"
#include "run/case/parts.h"

namespace monarch_flight::case_file {
namespace {

/// The map A0, AN, BN, multiple of a key, coefficients in `unit`.
FourierSeries readHarmonics(Section& motion, const std::string& key, const std::string& unit,
                            double frequency) {
  FourierSeries series;
  Section section = motion.section(key);
  series.a0 = section.number("A0", {Bound::kAny, unit, ""});
  series.an = section.numbers("AN", unit);
  series.bn = section.numbers("BN", unit);
  series.multiple = section.integer("multiple", "1: the flapping frequency itself");
  section.finish();
  if (!section.clean()) return series;
  if (series.an.size() != series.bn.size()) {
    section.fault("BN", " has " + std::to_string(series.bn.size()) +
                            " values: must be as many as AN, " + std::to_string(series.an.size()) +
                            "; fill up with 0");
  }
  if (series.multiple < 1) {
    section.fault("multiple", " = " + std::to_string(series.multiple) +
                                  ": must be >= 1; 1 is the flapping frequency itself");
  }
  if (!series.constant() && !(frequency > 0.0)) {
    section.fault("AN", ": harmonics need motion/frequency > 0; give it in Hz or leave A0 alone");
  }
  return series;
}

/// A number (constant angle) or a map A0, AN, BN, multiple; in degrees.
FourierSeries readAngle(Section& motion, const std::string& key, double frequency) {
  FourierSeries series;
  if (motion.has(key) && !motion.isMap(key)) {
    series.a0 = motion.number(key, {Bound::kAny, "deg", "or give A0, AN, BN, multiple"});
  } else {
    series = readHarmonics(motion, key, "deg", frequency);
  }
  series.a0 *= kDegree;
  series.an = inRadians(series.an);
  series.bn = inRadians(series.bn);
  return series;
}

/// Periodic part of the body's position [m]; none when the key is missing.
FourierSeries readSway(Section& body, const std::string& key, double frequency) {
  if (body.isMap(key)) return readHarmonics(body, key, "m", frequency);
  if (body.has(key) && body.textOf(key) != "none") {
    body.fault(key, " = '" + body.textOf(key) +
                        "': must be none or a section A0, AN, BN, multiple [m]; correct it");
  }
  body.take(key);
  body.put(key, std::string("none"));
  return {};
}

/// A lateral velocity in a Fourier motion, or "" (CaseMotion::lateral).
std::string lateralFault(const Section& body, const Eigen::Vector3d& velocity) {
  if (velocity.y() == 0.0) return "";
  return body.pathOf("velocity") + "[1] = " + exactText(velocity.y()) + " m/s: must be 0" +
         kMirrored + "set it to 0, or choose wings independent";
}

/// The first row of a table that lies further from the plane of the first one than rounding, or "".
std::string lateralFault(const NumericTable& table, double chord) {
  constexpr double kRounding = 1e-6;  // mean chords
  const std::vector<double> y = table.column("y");
  for (std::size_t i = 1; i < y.size(); ++i) {
    if (std::abs(y[i] - y[0]) <= kRounding * chord) continue;
    return table.name + ": row " + std::to_string(i + 1) + ", column y = " + exactText(y[i]) +
           " m: must stay " + exactText(y[0]) + " m" + kMirrored +
           "keep it there, or choose wings independent";
  }
  return "";
}

CaseMotion readFourier(Section& section, bool bare_wing) {
  FourierMotionSettings settings;
  settings.frequency = section.number(
      "frequency",
      {Bound::kNonNegative, "Hz", "a monarch flaps at about 10.2; 0: constant angles"});
  const double f = settings.frequency;
  settings.phi = readAngle(section, "phi_deg", f);
  settings.psi = readAngle(section, "psi_deg", f);
  settings.theta = readAngle(section, "theta_R_deg", f);
  if (!bare_wing) settings.theta_A = readAngle(section, "theta_A_deg", f);
  settings.pitch = readAngle(section, "theta_B_deg", f);
  Section body = section.section("body");
  settings.position = body.vector3("position", "m");
  settings.velocity = body.vector3("velocity", "m/s");
  settings.sway_x = readSway(body, "sway_x", f);
  settings.sway_z = readSway(body, "sway_z", f);
  body.finish();
  CaseMotion result;
  result.frequency = f;
  result.lateral = lateralFault(body, settings.velocity);
  if (section.clean()) result.motion = std::make_shared<FourierMotion>(settings);
  return result;
}

NumericTable readTableRows(Section& section, TableKind kind) {
  return readRows(section, TableMotion::columnsOf(kind));
}

CaseMotion readTable(Section& section, double chord, Faults& faults) {
  CaseMotion result;
  result.is_table = true;
  const std::string kind_text = section.choice("kind", {"wing", "body"});
  result.frequency = section.number(
      "frequency", {Bound::kNonNegative, "Hz", "0: the motion has no flapping period"});
  if (kind_text.empty()) return result;
  const TableKind kind = kind_text == "wing" ? TableKind::kWing : TableKind::kBody;
  result.is_wing_table = kind == TableKind::kWing;
  try {
    const NumericTable table = readTableRows(section, kind);
    if (!section.clean()) return result;
    const auto motion = std::make_shared<TableMotion>(table, kind, chord);
    result.lateral = lateralFault(table, chord);
    result.t_begin = motion->tBegin();
    result.t_end = motion->tEnd();
    result.motion = motion;
  } catch (const InputError& e) {
    faults.add(e.what());
  }
  return result;
}

}  // namespace

CaseMotion readMotion(Section section, bool bare_wing, double chord, Faults& faults) {
  const std::string type = section.choice("type", {"fourier", "table"});
  CaseMotion result;
  result.frequency = 1.0;  // unknown: no further fault from it
  if (type.empty()) return result;
  result = type == "fourier" ? readFourier(section, bare_wing) : readTable(section, chord, faults);
  section.finish();
  return result;
}

InitialValues readInitial(Section& root) {
  InitialValues initial;
  if (!root.has("initial")) {
    Section section = root.putSection("initial");
    for (const char* key :
         {"position", "velocity", "theta_B", "theta_B_dot", "theta_R", "theta_R_dot", "theta_L",
          "theta_L_dot", "roll", "yaw", "roll_dot", "yaw_dot"}) {
      section.put(key, std::string("none"));
    }
    return initial;
  }
  Section section = root.section("initial");
  initial.position = section.maybeVector3("position", "m");
  initial.velocity = section.maybeVector3("velocity", "m/s");
  initial.theta_B = section.maybeNumber("theta_B", {Bound::kAny, "rad", "or none"});
  initial.theta_B_dot = section.maybeNumber("theta_B_dot", {Bound::kAny, "rad/s", "or none"});
  initial.theta_R = section.maybeNumber("theta_R", {Bound::kAny, "rad", "or none"});
  initial.theta_R_dot = section.maybeNumber("theta_R_dot", {Bound::kAny, "rad/s", "or none"});
  initial.theta_L = section.maybeNumber("theta_L", {Bound::kAny, "rad", "or none"});
  initial.theta_L_dot = section.maybeNumber("theta_L_dot", {Bound::kAny, "rad/s", "or none"});
  initial.roll = section.maybeNumber("roll", {Bound::kAny, "rad", "or none"});
  initial.yaw = section.maybeNumber("yaw", {Bound::kAny, "rad", "or none"});
  initial.roll_dot = section.maybeNumber("roll_dot", {Bound::kAny, "rad/s", "or none"});
  initial.yaw_dot = section.maybeNumber("yaw_dot", {Bound::kAny, "rad/s", "or none"});
  section.finish();
  return initial;
}

}  // namespace monarch_flight::case_file
