#pragma once
#include <Eigen/Dense>

namespace monarch_flight {

/// One generalised coordinate with its first and second time derivatives (m or rad, per s, per s^2).
struct Coordinate {
  double q = 0.0;
  double qd = 0.0;
  double qdd = 0.0;
};

/// Motion of the body frame F_B (x forward, y right, z down) in the inertial NED frame F_I.
/// Invariant when the body only pitches: R_IB = exp(pitch.q e2), Omega_B = pitch.qd e2.
/// A motion table may hold any attitude; `pitch` is then its pitch angle asin(-R_IB(2,0)).
struct BodyState {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();            ///< position of the body's mass centre, F_I [m]
  Eigen::Vector3d v = Eigen::Vector3d::Zero();            ///< velocity, F_I [m/s]
  Eigen::Vector3d a = Eigen::Vector3d::Zero();            ///< acceleration, F_I [m/s^2]
  Eigen::Matrix3d R_IB = Eigen::Matrix3d::Identity();     ///< takes body components to inertial ones
  Eigen::Vector3d Omega_B = Eigen::Vector3d::Zero();      ///< angular velocity of B in I, body axes [rad/s]
  Eigen::Vector3d Omega_dot_B = Eigen::Vector3d::Zero();  ///< its time derivative, body axes [rad/s^2]
  Coordinate pitch;                                       ///< theta_B [rad]
};

/// Returns `body` with attitude, Omega and Omega_dot set from the pure pitch `pitch`.
BodyState withPitch(BodyState body, const Coordinate& pitch);

/// Joint angles that all participants take from the prescribed motion or, for theta, from the hinge.
struct JointAngles {
  Coordinate phi;      ///< flapping, both wings [rad]
  Coordinate psi;      ///< deviation, both wings [rad]
  Coordinate theta;    ///< wing pitch, both wings [rad]
  Coordinate theta_A;  ///< abdomen [rad]
};

/// What the three solvers must agree on at one time level.
struct Interface {
  BodyState body;
  Coordinate theta_R;  ///< passive wing pitch [rad]
};

/// Rigid motion of the right wing's axes: all that a flow solver needs to know of the insect.
/// Velocities and accelerations are absolute (relative to F_I), resolved in wing axes F_R.
struct WingMotion {
  Eigen::Vector3d r_I = Eigen::Vector3d::Zero();         ///< wing root, F_I [m]
  Eigen::Matrix3d R_IW = Eigen::Matrix3d::Identity();    ///< takes wing components to inertial ones
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();         ///< velocity of the root [m/s]
  Eigen::Vector3d omega_W = Eigen::Vector3d::Zero();     ///< angular velocity [rad/s]
  Eigen::Vector3d a_W = Eigen::Vector3d::Zero();         ///< R_IW^T d2(r_I)/dt2 [m/s^2]
  Eigen::Vector3d alpha_W = Eigen::Vector3d::Zero();     ///< d(omega_W)/dt, component-wise in F_R [rad/s^2]
};

/// Air loads on the right wing in wing axes, moments about the wing root [N, N m].
struct Loads {
  Eigen::Vector3d force_pressure = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_friction = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_pressure = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_friction = Eigen::Vector3d::Zero();
  Eigen::Vector3d force() const { return force_pressure + force_friction; }
  Eigen::Vector3d moment() const { return moment_pressure + moment_friction; }
  bool finite() const { return force().allFinite() && moment().allFinite(); }
};

}  // namespace monarch_flight
