#include <algorithm>
#include <cmath>

#include "monarch_flight/insect/insect.h"
#include "monarch_flight/insect/newmark.h"
#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {

// 0 - a, because -0.0 would not be the 0.0 of a symmetric flight.
Eigen::Vector3d polarImage(const Eigen::Vector3d& a) { return {a.x(), 0.0 - a.y(), a.z()}; }
Eigen::Vector3d axialImage(const Eigen::Vector3d& a) { return {0.0 - a.x(), a.y(), 0.0 - a.z()}; }

BodyState withPitch(BodyState body, const Coordinate& pitch) {
  body.pitch = pitch;
  body.q_IB = quaternionY(pitch.q);
  body.Omega_B = Eigen::Vector3d(0.0, pitch.qd, 0.0);
  body.Omega_dot_B = Eigen::Vector3d(0.0, pitch.qdd, 0.0);
  return body;
}

WingMotion relativeTo(const Wind& wind, WingMotion motion) {
  motion.v_W -= motion.R_IW.transpose() * wind.v;
  motion.a_W -= motion.R_IW.transpose() * wind.a;
  return motion;
}

bool onlyPitches(const BodyState& body) {
  return body.q_IB.x() == 0.0 && body.q_IB.z() == 0.0 && body.Omega_B.x() == 0.0 &&
         body.Omega_B.z() == 0.0 && body.Omega_dot_B.x() == 0.0 && body.Omega_dot_B.z() == 0.0;
}

// pitch = asin(-R(2,0)); R' = R W, R'' = R (W W + W') with W = hat(Omega).
void setPitchAngle(BodyState& body) {
  const Eigen::RowVector3d row = body.R_IB().row(2);
  const Eigen::Vector3d& w = body.Omega_B;
  const Eigen::Vector3d e1 = Eigen::Vector3d::UnitX();
  const double s = -row * e1;
  const double sd = -row.dot(w.cross(e1));
  const double sdd = -row.dot(w.cross(w.cross(e1)) + body.Omega_dot_B.cross(e1));
  const double c = std::sqrt(std::max(0.0, 1.0 - s * s));
  body.pitch = {std::asin(std::min(1.0, std::max(-1.0, s))), 0.0, 0.0};
  if (c > 1e-9) {
    body.pitch.qd = sd / c;
    body.pitch.qdd = sdd / c + s * sd * sd / (c * c * c);
  }
}

Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::min(1.0, std::max(-1.0, -R(2, 0)))),
          std::atan2(R(1, 0), R(0, 0))};
}

BodyState mirrored(const BodyState& body) {
  BodyState image = body;
  image.x = polarImage(body.x);
  image.v = polarImage(body.v);
  image.a = polarImage(body.a);
  image.q_IB.vec() = axialImage(body.q_IB.vec());
  image.Omega_B = axialImage(body.Omega_B);
  image.Omega_dot_B = axialImage(body.Omega_dot_B);
  return image;
}

CoordinateVector accelerations(const Interface& interface) {
  CoordinateVector all;
  all << interface.body.a, interface.body.Omega_dot_B, interface.theta.right.qdd,
      interface.theta.left.qdd;
  return all;
}

Wind mirrored(const Wind& wind) { return {polarImage(wind.v), polarImage(wind.a)}; }

Loads mirrored(const Loads& loads) {
  return {polarImage(loads.force_pressure), polarImage(loads.force_friction),
          axialImage(loads.moment_pressure), axialImage(loads.moment_friction)};
}

Eigen::Matrix3d wingAttitude(Side side, double beta, const WingAngles& angles) {
  const double sign = side == Side::kRight ? 1.0 : -1.0;
  return rotationY(beta) * rotationX(sign * angles.phi.q) * rotationZ(-sign * angles.psi.q) *
         rotationY(angles.theta.q);
}

Eigen::Matrix3d abdomenAttitude(const JointAngles& angles) { return rotationY(angles.theta_A.q); }

Eigen::Vector3d wingRate(const WingAngles& angles) {
  const auto& [phi, psi, theta] = angles;
  const double cp = std::cos(psi.q), sp = std::sin(psi.q);
  const double ct = std::cos(theta.q), st = std::sin(theta.q);
  return {phi.qd * cp * ct + psi.qd * st,  //
          phi.qd * sp + theta.qd,          //
          phi.qd * cp * st - psi.qd * ct};
}

Eigen::Vector3d wingRateDerivative(const WingAngles& angles) {
  const auto& [phi, psi, theta] = angles;
  const double cp = std::cos(psi.q), sp = std::sin(psi.q);
  const double ct = std::cos(theta.q), st = std::sin(theta.q);
  const double x = phi.qdd * cp * ct - phi.qd * psi.qd * sp * ct - phi.qd * theta.qd * cp * st +
                   psi.qdd * st + psi.qd * theta.qd * ct;
  const double y = phi.qdd * sp + phi.qd * psi.qd * cp + theta.qdd;
  const double z = phi.qdd * cp * st - phi.qd * psi.qd * sp * st + phi.qd * theta.qd * cp * ct -
                   psi.qdd * ct + psi.qd * theta.qd * st;
  return {x, y, z};
}

WingMotion wingMotion(Side side, const Insect& insect, const BodyState& true_body,
                      const JointAngles& all) {
  const BodyState body = side == Side::kRight ? true_body : mirrored(true_body);
  const WingAngles& angles = all.wings[side];
  const Eigen::Matrix3d Q = wingAttitude(Side::kRight, insect.beta, angles);
  const Eigen::Vector3d& mu = insect.wings[side].plate.mu;
  const Eigen::Vector3d& Omega = body.Omega_B;
  const Eigen::Vector3d rate = wingRate(angles);
  const Eigen::Vector3d Omega_W = Q.transpose() * Omega;  // body's angular velocity, wing axes

  WingMotion motion;
  const Eigen::Matrix3d R_IB = body.R_IB();
  motion.r_I = body.x + R_IB * mu;
  motion.R_IW = R_IB * Q;
  motion.v_W = motion.R_IW.transpose() * body.v + Q.transpose() * Omega.cross(mu);
  motion.omega_W = rate + Omega_W;
  motion.a_W = motion.R_IW.transpose() * body.a +
               Q.transpose() * (body.Omega_dot_B.cross(mu) + Omega.cross(Omega.cross(mu)));
  motion.alpha_W =
      wingRateDerivative(angles) + Q.transpose() * body.Omega_dot_B - rate.cross(Omega_W);
  return motion;
}

WingMotion wingMotionInAir(Side side, const Insect& insect, const Wind& wind, const BodyState& body,
                           const JointAngles& angles) {
  return relativeTo(side == Side::kRight ? wind : mirrored(wind),
                    wingMotion(side, insect, body, angles));
}

}  // namespace monarch_flight
