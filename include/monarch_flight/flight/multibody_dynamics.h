#pragma once
#include <array>

#include "monarch_flight/insect/insect.h"
#include "monarch_flight/insect/state.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

using Vector15d = Eigen::Matrix<double, 15, 1>;
using Matrix15d = Eigen::Matrix<double, 15, 15>;

/// Joint motion of an appendage relative to the body.
struct JointState {
  Eigen::Matrix3d Q = Eigen::Matrix3d::Identity();      ///< appendage axes to body axes
  Eigen::Vector3d Omega = Eigen::Vector3d::Zero();      ///< relative to the body, own axes [rad/s]
  Eigen::Vector3d Omega_dot = Eigen::Vector3d::Zero();  ///< its component-wise derivative [rad/s^2]
};

/// The whole insect's motion at one time; joints in the order right wing, left wing, abdomen.
struct InsectMotion {
  BodyState body;
  std::array<JointState, 3> joints;
};

/// Motion of the insect for a body state and joint angles, each wing in its true axes.
InsectMotion insectMotion(double beta, const BodyState& body, const JointAngles& angles);

/// Dynamics of body, two wings and abdomen in the velocities
/// xi = (x', Omega, Omega_R, Omega_L, Omega_A) (model.md section 2, Sridhar et al.'s eq. 2):
///   J_g xi' + bias = air + gravity + joint torques.
/// Omega of the body in body axes, the appendages' relative to the body in their own axes. Rows 1-3
/// are in F_I, 4-6 about the body's mass centre in body axes, 7-15 about the joints in appendage
/// axes. Fully three-dimensional. Not for a bare wing (std::invalid_argument).
class MultibodyDynamics {
 public:
  MultibodyDynamics(const Insect& insect, double gravity);

  /// J_g, symmetric, positive definite for positive masses.
  Matrix15d inertia(const InsectMotion& motion) const;
  /// Inertial side J_g xi' + bias, with the accelerations in `motion`.
  Vector15d inertialForce(const InsectMotion& motion) const;
  /// Inertial side without accelerations (centripetal and Coriolis terms).
  Vector15d bias(const InsectMotion& motion) const;
  /// Generalised forces of gravity.
  Vector15d gravityForce(const InsectMotion& motion) const;
  /// Generalised forces of the air on both wings (the left one's loads in the mirror, state.h).
  Vector15d airForce(const InsectMotion& motion, const PerWing<Loads>& loads) const;
  /// Generalised forces of one load per appendage (right, left, abdomen), own axes, about the
  /// joint.
  Vector15d appliedForce(const InsectMotion& motion,
                         const std::array<Eigen::Matrix<double, 6, 1>, 3>& loads) const;
  /// Torques that the joints exert on the right wing, the left wing and the abdomen, in their own
  /// axes, so that `motion` happens under these loads [N m].
  std::array<Eigen::Vector3d, 3> jointTorques(const InsectMotion& motion,
                                              const PerWing<Loads>& loads) const;

  double kineticEnergy(const InsectMotion& motion) const;    ///< [J]
  double potentialEnergy(const InsectMotion& motion) const;  ///< of gravity, zero at z = 0 [J]
  Eigen::Vector3d linearMomentum(const InsectMotion& motion) const;  ///< F_I [kg m/s]
  Eigen::Vector3d angularMomentum(
      const InsectMotion& motion) const;  ///< about F_I's origin, in F_I [kg m^2/s]
  Eigen::Vector3d massCentre(const InsectMotion& motion) const;  ///< F_I [m]

 private:
  /// (x', Omega, Omega_i) to joint velocity and total angular velocity, appendage axes.
  std::array<Eigen::Matrix<double, 6, 9>, 3> jointMaps(const InsectMotion& motion) const;

  Insect insect_;
  std::array<Appendage, 3> appendages_;
  double gravity_;
};

}  // namespace monarch_flight
