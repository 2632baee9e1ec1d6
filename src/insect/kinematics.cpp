#include <cmath>

#include "monarch_flight/insect/insect.h"
#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {

BodyState withPitch(BodyState body, const Coordinate& pitch) {
  body.pitch = pitch;
  body.R_IB = rotationY(pitch.q);
  body.Omega_B = Eigen::Vector3d(0.0, pitch.qd, 0.0);
  body.Omega_dot_B = Eigen::Vector3d(0.0, pitch.qdd, 0.0);
  return body;
}

WingMotion relativeTo(const Wind& wind, WingMotion motion) {
  motion.v_W -= motion.R_IW.transpose() * wind.v;
  motion.a_W -= motion.R_IW.transpose() * wind.a;
  return motion;
}

Eigen::Matrix3d wingAttitude(double beta, const JointAngles& angles) {
  return rotationY(beta) * rotationX(angles.phi.q) * rotationZ(-angles.psi.q) *
         rotationY(angles.theta.q);
}

Eigen::Matrix3d leftWingAttitude(double beta, const JointAngles& angles) {
  return rotationY(beta) * rotationX(-angles.phi.q) * rotationZ(angles.psi.q) *
         rotationY(angles.theta.q);
}

Eigen::Matrix3d abdomenAttitude(const JointAngles& angles) { return rotationY(angles.theta_A.q); }

Eigen::Vector3d wingRate(const JointAngles& angles) {
  const auto& [phi, psi, theta, theta_A] = angles;
  const double cp = std::cos(psi.q), sp = std::sin(psi.q);
  const double ct = std::cos(theta.q), st = std::sin(theta.q);
  return {phi.qd * cp * ct + psi.qd * st,  //
          phi.qd * sp + theta.qd,          //
          phi.qd * cp * st - psi.qd * ct};
}

Eigen::Vector3d wingRateDerivative(const JointAngles& angles) {
  const auto& [phi, psi, theta, theta_A] = angles;
  const double cp = std::cos(psi.q), sp = std::sin(psi.q);
  const double ct = std::cos(theta.q), st = std::sin(theta.q);
  const double x = phi.qdd * cp * ct - phi.qd * psi.qd * sp * ct - phi.qd * theta.qd * cp * st +
                   psi.qdd * st + psi.qd * theta.qd * ct;
  const double y = phi.qdd * sp + phi.qd * psi.qd * cp + theta.qdd;
  const double z = phi.qdd * cp * st - phi.qd * psi.qd * sp * st + phi.qd * theta.qd * cp * ct -
                   psi.qdd * ct + psi.qd * theta.qd * st;
  return {x, y, z};
}

WingMotion rightWingMotion(const Insect& insect, const BodyState& body, const JointAngles& angles) {
  const Eigen::Matrix3d Q = wingAttitude(insect.beta, angles);
  const Eigen::Vector3d& mu = insect.right.mu;
  const Eigen::Vector3d& Omega = body.Omega_B;
  const Eigen::Vector3d rate = wingRate(angles);
  const Eigen::Vector3d Omega_W = Q.transpose() * Omega;  // body's angular velocity, wing axes

  WingMotion motion;
  motion.r_I = body.x + body.R_IB * mu;
  motion.R_IW = body.R_IB * Q;
  motion.v_W = motion.R_IW.transpose() * body.v + Q.transpose() * Omega.cross(mu);
  motion.omega_W = rate + Omega_W;
  motion.a_W = motion.R_IW.transpose() * body.a +
               Q.transpose() * (body.Omega_dot_B.cross(mu) + Omega.cross(Omega.cross(mu)));
  motion.alpha_W =
      wingRateDerivative(angles) + Q.transpose() * body.Omega_dot_B - rate.cross(Omega_W);
  return motion;
}

}  // namespace monarch_flight
