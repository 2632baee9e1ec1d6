#pragma once
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// Reference of the pressure coefficient Cp = p / (rho U_ref^2 / 2).
struct PressureReference {
  double speed = 1.0;    ///< U_ref [m/s]
  double dynamic = 1.0;  ///< rho U_ref^2 / 2 [Pa]
};

/// U_ref is the largest speed of the wing's outline through the air in the first period
/// (wing_speeds.h, referenceSpeed); 1 m/s when it does not move. One constant for the whole run, so
/// that colours of different times compare.
PressureReference pressureReference(const Case& c);

}  // namespace monarch_flight
