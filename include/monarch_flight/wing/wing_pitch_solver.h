#pragma once
#include "monarch_flight/insect/insect.h"
#include "monarch_flight/insect/newmark.h"
#include "monarch_flight/insect/state.h"
#include "monarch_flight/wing/hinge.h"

namespace monarch_flight {

/// Passive pitch of a wing on its torsional hinge (the left one in the mirror, state.h): the y row,
/// in wing axes, of the wing's Newton-Euler equation about its root,
///   [ m nu x (a - g) + J alpha + w x J w ]_y = M_y + M_hinge(theta, theta', rest_angle),
/// with the torque law of the hinge (hinge.h), the root's absolute acceleration a, the total
/// angular velocity w and acceleration alpha. It holds for every motion of the body, that of a bare
/// wing from a table included.
class WingPitchSolver {
 public:
  /// `gravity` along +z of NED [m/s^2]. Throws std::invalid_argument when J_yy is not positive.
  WingPitchSolver(Side side, const Insect& insect, double gravity, const Newmark& newmark);

  /// theta'' [rad/s^2] for the body's motion, the joint angles (its own theta'' is not used), the
  /// air's moment about the wing root, wing axes, and a shift of the hinge's rest angle [rad].
  double acceleration(const BodyState& body, const JointAngles& angles, const Loads& loads,
                      double rest_angle = 0.0) const;

  /// theta at level n+1 by Newmark from `n`. `angles` is the guess of level n+1; the hinge's torque
  /// is taken at the new angle (implicitly), all other terms at the guess, so that with the guess
  /// equal to the answer this is the implicit Newmark step.
  Coordinate step(const Coordinate& n, const BodyState& body, const JointAngles& angles,
                  const Loads& loads, double rest_angle = 0.0) const;

 private:
  /// All of J_yy theta'' but the hinge's torque [N m].
  double momentWithoutHinge(const BodyState& body, JointAngles angles, const Loads& loads) const;

  const Wing& wing() const { return insect_.wings[side_]; }

  Side side_;
  Insect insect_;
  double gravity_;
  Newmark newmark_;
  Hinge hinge_;
};

}  // namespace monarch_flight
