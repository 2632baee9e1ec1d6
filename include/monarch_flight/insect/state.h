#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "monarch_flight/math/eigen.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {

/// One generalised coordinate with its first and second time derivatives (m or rad, per s, per
/// s^2).
struct Coordinate {
  double q = 0.0;
  double qd = 0.0;
  double qdd = 0.0;
};

/// The two wings. Whatever belongs to the left one - angles, planform, loads - is told as its
/// mirror image across the body's x-z plane: as if it were a right wing. In a symmetric flight both
/// sides have the same numbers.
enum class Side : std::uint8_t { kRight = 0, kLeft = 1 };
inline constexpr std::array<Side, 2> kSides = {Side::kRight, Side::kLeft};

/// The right wing, or both, to go through: for (Side side : sides).
struct Sides {
  std::size_t count;
  const Side* begin() const { return kSides.data(); }
  const Side* end() const { return kSides.data() + count; }
};

/// One of something for each wing.
template <class T>
struct PerWing {
  T right{};
  T left{};
  T& operator[](Side side) { return side == Side::kRight ? right : left; }
  const T& operator[](Side side) const { return side == Side::kRight ? right : left; }
};

/// Motion of the body frame F_B (x forward, y right, z down) in the inertial NED frame F_I.
/// Invariant while the body only pitches: q_IB = (cos(pitch.q / 2), 0, sin(pitch.q / 2), 0),
/// Omega_B = pitch.qd e2. In any other attitude `pitch` is the pitch angle asin(-R_IB(2,0))
/// (setPitchAngle).
struct BodyState {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  ///< position of the body's mass centre, F_I [m]
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< velocity, F_I [m/s]
  Eigen::Vector3d a = Eigen::Vector3d::Zero();  ///< acceleration, F_I [m/s^2]
  Quaternion q_IB = Quaternion::Identity();     ///< attitude: unit quaternion of R_IB
  Eigen::Vector3d Omega_B =
      Eigen::Vector3d::Zero();  ///< angular velocity of B in I, body axes [rad/s]
  Eigen::Vector3d Omega_dot_B =
      Eigen::Vector3d::Zero();  ///< its time derivative, body axes [rad/s^2]
  Coordinate pitch;             ///< theta_B [rad]
  /// Takes body components to inertial ones.
  Eigen::Matrix3d R_IB() const { return rotationOf(q_IB); }
};

/// Images in the mirror y = 0: of a vector, and of one that turns (angular velocity, moment).
Eigen::Vector3d polarImage(const Eigen::Vector3d& a);
Eigen::Vector3d axialImage(const Eigen::Vector3d& a);

/// Returns `body` with attitude, Omega and Omega_dot set from the pure pitch `pitch`.
BodyState withPitch(BodyState body, const Coordinate& pitch);
/// Whether the body only pitches, to the last bit: neither attitude nor rates hold roll or yaw.
bool onlyPitches(const BodyState& body);
/// Sets `pitch` from attitude, Omega and Omega_dot; at +-90 deg without derivatives.
void setPitchAngle(BodyState& body);
/// Roll, pitch and yaw of an attitude (z-y-x, yaw first), pitch within +-90 deg [rad].
Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d& R_IB);
/// Mirror image across the inertial plane y = 0. Exact, without negative zeros.
BodyState mirrored(const BodyState& body);

/// Joint angles of one wing [rad].
struct WingAngles {
  Coordinate phi;    ///< flapping
  Coordinate psi;    ///< deviation
  Coordinate theta;  ///< wing pitch
};

/// All joint angles; from guidance or, for theta, from the hinge.
struct JointAngles {
  PerWing<WingAngles> wings;
  Coordinate theta_A;  ///< abdomen [rad]
};

/// What the three solvers must agree on at one time level.
struct Interface {
  BodyState body;
  PerWing<Coordinate> theta;  ///< wing pitch [rad]
};

/// Rigid motion of a (right) wing's axes: all that a flow solver needs to know of the insect.
/// Velocities and accelerations are absolute (relative to F_I), resolved in wing axes F_R.
struct WingMotion {
  Eigen::Vector3d r_I = Eigen::Vector3d::Zero();       ///< wing root, F_I [m]
  Eigen::Matrix3d R_IW = Eigen::Matrix3d::Identity();  ///< takes wing components to inertial ones
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();       ///< velocity of the root [m/s]
  Eigen::Vector3d omega_W = Eigen::Vector3d::Zero();   ///< angular velocity [rad/s]
  Eigen::Vector3d a_W = Eigen::Vector3d::Zero();       ///< R_IW^T d2(r_I)/dt2 [m/s^2]
  Eigen::Vector3d alpha_W =
      Eigen::Vector3d::Zero();  ///< d(omega_W)/dt, component-wise in F_R [rad/s^2]
};

/// Air loads on one wing in wing axes, moments about the wing root [N, N m].
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
