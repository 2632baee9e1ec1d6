#pragma once
#include "monarch_flight/insect/insect.h"
#include "monarch_flight/insect/state.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// Uniform motion of the air at one time, F_I (NED): where it goes to.
struct Wind {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< velocity [m/s]
  Eigen::Vector3d a = Eigen::Vector3d::Zero();  ///< acceleration [m/s^2]
};

/// The wing's motion as air at rest sees it: relative to the wind. A uniform wind, steady or not,
/// does nothing else to a wing without volume (Galilean invariance).
WingMotion relativeTo(const Wind& wind, WingMotion motion);
/// Mirror image across the inertial plane y = 0.
Wind mirrored(const Wind& wind);
/// wingMotion, as air at rest sees it.
WingMotion wingMotionInAir(Side side, const Insect& insect, const Wind& wind, const BodyState& body,
                           const JointAngles& angles);

/// Everything that is prescribed at one time level. What the equations of motion move is in it,
/// too, as the motion description has it: the start, and what the prescribed steps fly.
struct PrescribedState {
  BodyState body;
  JointAngles angles;
  PerWing<double> rest_angle;  ///< added to the hinges' own rest angles theta_0 [rad]
  Wind wind;

  /// The joint angles with these wing pitches.
  JointAngles anglesWith(const PerWing<Coordinate>& theta) const {
    JointAngles all = angles;
    for (Side side : kSides) all.wings[side].theta = theta[side];
    return all;
  }
  /// Body and wing pitch as prescribed.
  Interface interface() const {
    return {body, {angles.wings.right.theta, angles.wings.left.theta}};
  }
};

/// Motion as a function of time, with consistent first and second derivatives. Immutable,
/// thread-safe. Concrete: FourierMotion, TableMotion (fourier_motion.h, table_motion.h).
class PrescribedMotion {
 public:
  virtual ~PrescribedMotion() = default;
  /// t in s; throws std::out_of_range (naming the bounds) where a table does not reach.
  virtual PrescribedState at(double t) const = 0;
};

}  // namespace monarch_flight
