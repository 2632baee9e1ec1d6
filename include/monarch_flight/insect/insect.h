#pragma once
#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/insect/planform.h"
#include "monarch_flight/insect/state.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// A rigid appendage on a joint of the body.
struct Appendage {
  double m = 0.0;                                ///< mass [kg]
  Eigen::Vector3d nu = Eigen::Vector3d::Zero();  ///< mass centre from the joint, own axes [m]
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();   ///< inertia about the joint, own axes [kg m^2]
  Eigen::Vector3d mu =
      Eigen::Vector3d::Zero();  ///< joint in body axes F_B, from the body's mass centre [m]
};

/// What a hinge has beside the paper's linear spring; all of it zero or none: nothing. wing/hinge.h
/// has the law.
struct HingeAdditions {
  double damping = 0.0;                       ///< of a damper [N m s/rad]
  double cubic_stiffness = 0.0;               ///< of a stiffening spring [N m/rad^3]
  std::optional<double> stop_low, stop_high;  ///< pitch at which the stops begin [rad]
  double stop_stiffness = 0.0;                ///< of the springs behind the stops [N m/rad]

  bool any() const { return damping != 0.0 || cubic_stiffness != 0.0 || stop_low || stop_high; }
};

/// A wing with its hinge; the left one as its mirror image (state.h).
struct Wing {
  Appendage plate;       ///< own axes; `mu` is the wing's root
  Planform planform;     ///< own axes
  double kappa = 0.0;    ///< hinge stiffness kappa_T [N m/rad]
  double theta_0 = 0.0;  ///< rest angle of the hinge [rad]
  HingeAdditions additions;
};

/// Constant model of the insect (or of a bare wing: massless body and abdomen, one wing).
struct Insect {
  std::string name;
  bool bare_wing =
      false;         ///< true: one wing, no body or abdomen; nothing but wing pitch may be free
  double m_B = 0.0;  ///< body (thorax and head) [kg]
  Eigen::Matrix3d J_B = Eigen::Matrix3d::Zero();     ///< about the body's mass centre [kg m^2]
  double body_length = 0.0, body_width = 0.0;        ///< cylinder, for pictures and inertia [m]
  double abdomen_length = 0.0, abdomen_width = 0.0;  ///< [m]
  Appendage abdomen;
  double beta = 0.0;    ///< stroke plane angle [rad]
  PerWing<Wing> wings;  ///< a bare wing: the right one, and a copy

  double totalMass() const;
  /// Mean chord of both wings [m].
  double meanChord() const;
  int wingCount() const { return bare_wing ? 1 : 2; }
  /// Every fault at once, each as "insect/key = value unit: must be ... ; remedy".
  std::vector<std::string> problems() const;
};

/// Every fault of a butterfly's wing that the case has in `section` of insect.
std::vector<std::string> wingProblems(const std::string& section, const Wing& wing);

/// Flat plate of uniform areal density: nu, J from the planform's moments. `mu` as given.
Appendage plateWing(const Planform& planform, double mass, const Eigen::Vector3d& mu);
/// Mirror image across the body's x-z plane.
Appendage mirrored(const Appendage& right);

/// Mirror image across the body's x-z plane, as air loads on the other wing.
Loads mirrored(const Loads& loads);

/// Q_R, Q_L (model.md section 1): the wing's true axes to body axes, Q_L being a mirror image.
Eigen::Matrix3d wingAttitude(Side side, double beta, const WingAngles& angles);
/// Q_A: abdomen axes to body axes.
Eigen::Matrix3d abdomenAttitude(const JointAngles& angles);
/// Omega_R, relative to the body, right wing axes [rad/s], and its component-wise derivative
/// [rad/s^2].
Eigen::Vector3d wingRate(const WingAngles& angles);
Eigen::Vector3d wingRateDerivative(const WingAngles& angles);

/// Absolute motion of a wing's axes for a body state and joint angles; the left wing's is seen in a
/// mirror, the inertial plane y = 0, where it is a right wing.
WingMotion wingMotion(Side side, const Insect& insect, const BodyState& body,
                      const JointAngles& angles);

}  // namespace monarch_flight
