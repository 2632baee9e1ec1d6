#include "monarch_flight/run/pressure_reference.h"

#include <algorithm>
#include <cmath>

namespace monarch_flight {

PressureReference pressureReference(const Case& c) {
  constexpr int kSamples = 200;
  const double whole = c.time.steps * c.time.dt;
  const double duration = c.time.period > 0.0 ? std::min(c.time.period, whole) : whole;
  const Eigen::Vector3d tip(0.0, c.insect.planform.yTip(), 0.0);
  double fastest = 0.0;
  for (int i = 0; i <= kSamples; ++i) {
    const PrescribedState state = c.motion->at(c.time.t_start + duration * i / kSamples);
    const WingMotion wing = rightWingMotion(c.insect, state.body, state.angles);
    const Eigen::Vector3d wind = wing.R_IW.transpose() * c.air.wind_I;
    fastest = std::max(fastest, (wing.v_W + wing.omega_W.cross(tip) - wind).norm());
  }
  PressureReference out;
  out.speed = fastest > 0.0 ? fastest : 1.0;
  out.dynamic = 0.5 * c.air.rho * out.speed * out.speed;
  return out;
}

}  // namespace monarch_flight
