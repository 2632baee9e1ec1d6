#pragma once
#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/insect/newmark.h"

namespace monarch_flight {

/// Level n+1 of the body: the free ones of x, z, pitch by Newmark from level n with the
/// accelerations (x'', z'', theta_B''; the entries of prescribed coordinates are not used), the
/// rest from `prescribed`. A free pitch makes the attitude a pure pitch.
BodyState advancedBody(const BodyState& n, const BodyState& prescribed, const FreeCoordinates& free,
                       const Newmark& newmark, const Eigen::Vector3d& accelerations);

/// Longitudinal flight: the free ones of x, z, pitch move by the equations of motion of the whole
/// insect, everything else is prescribed.
class FlightSolver {
 public:
  /// Throws InputError when a bare wing shall move freely. `gravity` along +z of NED [m/s^2].
  FlightSolver(const Insect& insect, double gravity, const FreeCoordinates& free,
               const Newmark& newmark);

  /// Accelerations (x'', z'', theta_B'') in the state `guess` with these joint angles and loads on
  /// the right wing: of the free coordinates from the equations of motion, of the others as in
  /// `guess`. Throws NumericalError when the mass matrix of the free coordinates is not positive
  /// definite.
  Eigen::Vector3d accelerations(const BodyState& guess, const JointAngles& angles,
                                const Loads& loads) const;

  /// The body at level n+1 by Newmark from the committed level n, with the accelerations in the
  /// state `guess` of level n+1; prescribed coordinates are those of `prescribed`. Throws
  /// InputError when pitch is free and the attitude of `n` is more than a pitch.
  BodyState step(const BodyState& n, const BodyState& prescribed, const BodyState& guess,
                 const JointAngles& angles, const Loads& loads) const;

  const MultibodyDynamics& dynamics() const { return dynamics_; }

 private:
  double beta_;
  MultibodyDynamics dynamics_;
  FreeCoordinates free_;
  Newmark newmark_;
};

}  // namespace monarch_flight
