#pragma once
#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/insect/newmark.h"

namespace monarch_flight {

/// Translation (F_I), then rotation (body axes).
using BodyVector = Eigen::Matrix<double, 6, 1>;

/// Level n+1 of the body by Newmark from level n: what is free with `accelerations` (x'', y'', z'',
/// Omega'; the entries of prescribed coordinates are not used), the rest from `prescribed`.
/// Attitude moves on the group, R_{n+1} = R_n exp(d^), d being Newmark's increment of the angular
/// velocity in body axes (Bruls, Cardona & Arnold 2012); where only some of its components are
/// free, the others are those of `prescribed`. A body that only pitches goes on by its angle alone,
/// so that it stays in its plane to the last bit.
BodyState advancedBody(const BodyState& n, const BodyState& prescribed, const FreeCoordinates& free,
                       const Newmark& newmark, const BodyVector& accelerations);

/// Flight: what is free of the body moves by the equations of motion of the whole insect,
/// everything else is prescribed.
class FlightSolver {
 public:
  /// Throws InputError when a bare wing shall move freely. `gravity` along +z of NED [m/s^2].
  FlightSolver(const Insect& insect, double gravity, const FreeCoordinates& free,
               const Newmark& newmark);

  /// Accelerations in the state `guess` with these joint angles and loads: of the free coordinates
  /// from the equations of motion, of the others as in `guess`. Throws NumericalError when the mass
  /// matrix of the free coordinates is not positive definite.
  BodyVector accelerations(const BodyState& guess, const JointAngles& angles,
                           const PerWing<Loads>& loads) const;

  /// The body at level n+1 by Newmark from the committed level n, with the accelerations in the
  /// state `guess` of level n+1; prescribed coordinates are those of `prescribed`. Throws
  /// InputError when of its rotations pitch alone is free and the attitude of `n` is more than a
  /// pitch.
  BodyState step(const BodyState& n, const BodyState& prescribed, const BodyState& guess,
                 const JointAngles& angles, const PerWing<Loads>& loads) const;

  const MultibodyDynamics& dynamics() const { return dynamics_; }

 private:
  double beta_;
  MultibodyDynamics dynamics_;
  FreeCoordinates free_;
  Newmark newmark_;
};

}  // namespace monarch_flight
