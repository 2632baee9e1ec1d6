#include "monarch_flight/coupling/model.h"

#include <cmath>

namespace monarch_flight {

Interface CoupledModel::departure(std::uint32_t step, Interface committed,
                                  const Interface& next) const {
  if (release == 0 || step != release) return committed;
  committed.body.a = next.body.a;
  committed.body.Omega_dot_B = next.body.Omega_dot_B;
  committed.body.pitch.qdd = next.body.pitch.qdd;
  for (Side side : kSides) committed.theta[side].qdd = next.theta[side].qdd;
  return committed;
}

std::vector<std::string> CoupledModel::problems() const {
  std::vector<std::string> faults;
  if (!(std::isfinite(newmark.dt) && newmark.dt > 0.0)) {
    faults.push_back("time/dt = " + std::to_string(newmark.dt) + " s: must be above 0");
  }
  if (!(newmark.beta > 0.0 && newmark.beta <= 0.5)) {
    faults.push_back("newmark/beta = " + std::to_string(newmark.beta) +
                     ": must be in (0, 0.5]; 0.25 is the average acceleration");
  }
  if (!(newmark.gamma >= 0.5 && newmark.gamma <= 1.0)) {
    faults.push_back("newmark/gamma = " + std::to_string(newmark.gamma) +
                     ": must be in [0.5, 1]; 0.5 is of second order");
  }
  if (!std::isfinite(gravity) || !std::isfinite(t_start)) {
    faults.push_back("gravity, time/t_start: must be finite numbers");
  }
  if (insect.bare_wing && free.body()) {
    faults.push_back(
        "free/x, y, z, roll, pitch, yaw: must be false for a bare wing, which has no body to move");
  }
  if (mirrored && (free.lateral() || free[kThetaL])) {
    faults.push_back(
        "free/y, roll, yaw, pitch of the left wing: must be false while one wing is the mirror "
        "image "
        "of the other; set wings to independent");
  }
  if (insect.bare_wing && !mirrored)
    faults.push_back("wings = independent: a bare wing is one wing; set wings to mirrored");
  return faults;
}

}  // namespace monarch_flight
