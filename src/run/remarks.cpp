#include "monarch_flight/run/remarks.h"

#include <sstream>

namespace monarch_flight {

std::vector<std::string> runRemarks(const Case& c, std::uint32_t steps) {
  std::vector<std::string> remarks;
  const int prescribed = c.coupling.prescribed_steps;
  if (c.free.count() > 0 && steps > 0 && std::int64_t{steps} <= prescribed) {
    remarks.push_back("nothing is ever free: all " + std::to_string(steps) +
                      " steps follow the motion (coupling/prescribed_steps = " +
                      std::to_string(prescribed) + "); fly more steps than that, or lower it");
  }
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
