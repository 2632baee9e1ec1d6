#pragma once
#include "monarch_flight/insect/insect.h"
#include "monarch_flight/insect/newmark.h"

namespace monarch_flight {

/// Torque law of a wing's hinge about its pitch axis, all of it in one place. The paper's hinge is
/// a linear spring, M = -kappa e with e = theta - theta_0 - rest_angle. Additions to it, none
/// unless the case asks for them (HingeAdditions):
///   a stiffening spring  -cubic_stiffness e^3,
///   a damper             -damping theta',
///   stops                -stop_stiffness (theta - stop) beyond stop_low or stop_high.
class Hinge {
 public:
  explicit Hinge(const Wing& wing)
      : kappa_(wing.kappa), theta_0_(wing.theta_0), additions_(wing.additions) {}

  /// M [N m] for a shift of the rest angle [rad].
  double torque(double theta, double theta_dot, double rest_angle) const;
  /// -dM/dtheta [N m/rad].
  double stiffness(double theta, double rest_angle) const;

  /// theta'' of inertia theta'' = moment + M, `moment` being that of all else [N m].
  double acceleration(double inertia, double moment, const Coordinate& theta,
                      double rest_angle) const;
  /// theta at level n+1 by Newmark from `n`, of inertia theta'' = moment + M with M at n+1.
  Coordinate step(const Newmark& newmark, const Coordinate& n, double inertia, double moment,
                  double rest_angle) const;

 private:
  double beyondStops(double theta) const;
  /// Of all but the linear spring.
  double addedTorque(double theta, double theta_dot, double rest_angle) const;

  double kappa_, theta_0_;
  HingeAdditions additions_;
};

}  // namespace monarch_flight
