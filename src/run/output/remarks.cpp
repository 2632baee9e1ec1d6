#include "monarch_flight/run/remarks.h"

#include <sstream>

#include "run/case/parts.h"

namespace monarch_flight {
namespace {

// In a swing of the hinge: theta_R is then 1 % off, with 10 (the least) 10 %, with n 1000 % / n^2
// (docs/case_files.md, time).
constexpr double kGoodSteps = 30.0;

/// Of the stiffer hinge; "" where its swings are well resolved.
std::string hingeRemark(const Case& c) {
  double period = 0.0;
  const char* section = "";
  for (Side side : c.sides()) {
    const double swing = case_file::hingePeriod(c, c.insect.wings[side]);
    if (swing == 0.0 || (period > 0.0 && swing >= period)) continue;
    period = swing;
    section = side == Side::kRight ? "wing" : "left_wing";
  }
  const double steps = period / c.time.dt;
  if (period == 0.0 || steps >= kGoodSteps) return "";
  std::ostringstream text;
  text.precision(3);
  text << "the free wing swings on its hinge (insect/" << section << "/kappa) in " << period
       << " s, which has only " << steps << " time steps: its pitch will be about "
       << 1000.0 / (steps * steps) << " % off; for 1 % take "
       << case_file::shorterSteps(c, period / kGoodSteps);
  return text.str();
}

}  // namespace

std::vector<std::string> runRemarks(const Case& c, std::uint32_t steps) {
  std::vector<std::string> remarks;
  const int prescribed = c.coupling.prescribed_steps;
  if (c.free.count() > 0 && steps > 0 && std::int64_t{steps} <= prescribed) {
    remarks.push_back("nothing is ever free: all " + std::to_string(steps) +
                      " steps follow the motion, as the first " + std::to_string(prescribed) +
                      " of this case do (coupling/prescribed_flaps or prescribed_steps); fly more "
                      "steps than that, or lower it");
  }
  const std::string hinge = hingeRemark(c);
  if (!hinge.empty()) remarks.push_back(hinge);
  const bool aside = c.free[kY] || c.free[kRoll] || c.free[kYaw];
  if (aside && c.guidance.controller && !c.guidance.controller->lateral) {
    remarks.push_back(
        "the controller has no section lateral: roll, heading and side-slip are left alone, and "
        "the "
        "flight may leave the plane; let monarch trim write one (control:=true, "
        "wings:=independent), "
        "or set free/y, free/roll and free/yaw to false");
  }
  if (c.time.remainder > 0.0 && steps == c.time.steps) {
    std::ostringstream text;
    text << "the run ends with its last whole step, " << c.time.steps << ", after "
         << c.time.steps * c.time.dt << " s; the remainder of " << c.time.remainder
         << " steps is not flown: the length asked for is no whole number of steps";
    remarks.push_back(text.str());
  }
  return remarks;
}

}  // namespace monarch_flight
