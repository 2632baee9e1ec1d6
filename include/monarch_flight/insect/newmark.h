#pragma once
#include "monarch_flight/insect/state.h"

namespace monarch_flight {

/// Which coordinates the equations of motion move; the others follow the prescribed motion.
struct FreeCoordinates {
  bool x = false, z = false, pitch = false, wing_pitch = false;
  int count() const { return int(x) + int(z) + int(pitch) + int(wing_pitch); }
};

/// Newmark-beta (average acceleration): q_{n+1} = q_n + dt qd_n + dt^2 ((1/2 - beta) qdd_n + beta
/// qdd_{n+1}).
struct Newmark {
  double beta = 0.25;
  double gamma = 0.5;
  double dt = 0.0;  ///< [s]

  /// The coordinate at n+1 for the acceleration qdd there.
  Coordinate advance(const Coordinate& n, double qdd) const {
    Coordinate next;
    next.q = n.q + dt * n.qd + dt * dt * ((0.5 - beta) * n.qdd + beta * qdd);
    next.qd = n.qd + dt * ((1.0 - gamma) * n.qdd + gamma * qdd);
    next.qdd = qdd;
    return next;
  }
};

}  // namespace monarch_flight
