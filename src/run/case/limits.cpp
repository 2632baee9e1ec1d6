// What a case asks for that the model or its time step cannot give.
#include <cmath>
#include <sstream>

#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/run/wing_speeds.h"
#include "run/case/parts.h"

namespace monarch_flight::case_file {
namespace {

// In a natural period of the hinge: theta_R is then 10 % off (docs/case_files.md, time).
constexpr double kLeastSteps = 10.0;
constexpr double kFar = 1.0;       // from rest, where a stiffening spring counts [rad]
constexpr double kMostTurn = 1.0;  // of the wing in a step [rad]: six steps in a turn

/// Of the hinge where the wing is far from rest (kFar), stops included [N m/rad].
double stiffest(const Wing& wing) {
  const HingeAdditions& more = wing.additions;
  const bool stops = more.stop_low || more.stop_high;
  return wing.kappa + 3.0 * more.cubic_stiffness * kFar * kFar +
         (stops ? more.stop_stiffness : 0.0);
}

/// Of the wing about its hinge, in air [kg m2].
double hingeInertia(const Case& c, const Wing& wing) {
  return wing.plate.J(1, 1) +
         makeQuasiSteady(wing.planform, c.air, c.blade_element)->addedMass()(4, 4);
}

void checkHinge(const Case& c, const Wing& wing, const char* section, Faults& faults) {
  const double period = hingePeriod(c, wing), longest = period / kLeastSteps;
  if (period == 0.0 || c.time.dt <= longest) return;
  std::ostringstream text;
  text << "insect/" << section << "/kappa = " << wing.kappa << " N m/rad"
       << (wing.additions.any() ? " with its hinge_additions" : "") << ": the free wing swings in "
       << period << " s on this hinge: must be at least " << kLeastSteps
       << " steps of dt = " << c.time.dt << " s, else the time step makes its swings; take "
       << (wing.additions.any() ? "kappa + 3 cubic_stiffness + stop_stiffness <= " : "kappa <= ")
       << hingeInertia(c, wing) * std::pow(2.0 * M_PI / (kLeastSteps * c.time.dt), 2) << ", or "
       << shorterSteps(c, longest);
  faults.add(text.str());
}

void checkTurns(const Case& c, Faults& faults) {
  const double fastest = peakWingSpeeds(c).turn;
  const double turn = fastest * c.time.dt;
  if (turn <= kMostTurn) return;
  std::ostringstream text;
  text << "time: the wing turns by up to " << turn << " rad in a step of dt = " << c.time.dt
       << " s: must be <= " << kMostTurn << "; take " << shorterSteps(c, kMostTurn / fastest);
  faults.add(text.str());
}

}  // namespace

double hingePeriod(const Case& c, const Wing& wing) {
  const double stiffness = stiffest(wing);
  if (!c.free[kThetaR] || !(stiffness > 0.0)) return 0.0;
  return 2.0 * M_PI * std::sqrt(hingeInertia(c, wing) / stiffness);
}

std::string shorterSteps(const Case& c, double dt) {
  std::ostringstream text;
  text << "dt <= " << dt << " s";
  if (c.time.period > 0.0) {
    text << " (steps_per_flap >= " << std::ceil(c.time.period / dt * (1.0 - 1e-9)) << ')';
  }
  return text.str();
}

void checkTimeStep(const Case& c, Faults& faults) {
  checkHinge(c, c.insect.wings.right, "wing", faults);
  if (!c.mirrored) checkHinge(c, c.insect.wings.left, "left_wing", faults);
  checkTurns(c, faults);
}

void checkMirrored(const Case& c, const CaseMotion& motion, const InitialValues& initial,
                   Faults& faults) {
  if (c.insect.bare_wing || !c.mirrored) return;
  if (!motion.lateral.empty()) faults.add(motion.lateral);
  if (initial.velocity && initial.velocity->y() != 0.0) {
    faults.add("initial/velocity[1] = " + exactText(initial.velocity->y()) + " m/s: must be 0" +
               kMirrored + "set it to 0");
  }
  for (const auto& [name, value] :
       {std::pair{"theta_L", initial.theta_L}, {"theta_L_dot", initial.theta_L_dot}}) {
    if (value)
      faults.add(std::string("initial/") + name + " = " + exactText(*value) + ": must be none" +
                 kMirrored + "set it to none");
  }
  for (const auto& [name, i] : {std::pair{"y", kY}, {"roll", kRoll}, {"yaw", kYaw}}) {
    if (c.free[i])
      faults.add(
          std::string("free/") + name +
          " = true: must be false while one wing is the mirror image of the other; set it to "
          "false, or wings to independent");
  }
}

}  // namespace monarch_flight::case_file
