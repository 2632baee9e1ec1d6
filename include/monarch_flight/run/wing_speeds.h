#pragma once
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// Largest speeds of the right wing through the air that the prescribed motion reaches,
/// whenever a gust is met: never less than in any air that the wind's range holds (wind_model.h).
struct WingSpeeds {
  double root = 0.0;     ///< of the wing's root, the origin of its axes [m/s]
  double outline = 0.0;  ///< of the fastest point of its outline: no point is faster [m/s]
  double turn = 0.0;     ///< angular velocity of the wing [rad/s]
};

/// Over `duration` [s] from the start of the run, at up to 2001 instants evenly apart.
WingSpeeds peakWingSpeeds(const Case& c, double duration);
/// Over the whole run.
WingSpeeds peakWingSpeeds(const Case& c);
/// Speed of the outline in the wind that the prescribed motion meets, over the first flapping
/// period, or over the run where that is shorter or there is no period [m/s].
double referenceSpeed(const Case& c);

/// Q that shows the vortices of the wing's edges: a tenth of (referenceSpeed / mean chord)^2
/// [1/s^2].
double vortexThreshold(const Case& c);

}  // namespace monarch_flight
