#include "monarch_flight/run/pressure_reference.h"

#include "monarch_flight/run/wing_speeds.h"

namespace monarch_flight {

PressureReference pressureReference(const Case& c) {
  const double speed = c.motion && c.wind ? referenceSpeed(c) : 0.0;
  PressureReference out;
  out.speed = speed > 0.0 ? speed : 1.0;
  out.dynamic = 0.5 * c.air.rho * out.speed * out.speed;
  return out;
}

}  // namespace monarch_flight
