#include "monarch_flight/insect/heading.h"

#include <cmath>

namespace monarch_flight {
namespace {

/// Rates of the z-y-x angles from Omega = E^-1 (roll', pitch', yaw') and its derivative.
void setRates(HeadingMotion& m, const Eigen::Vector3d& w, const Eigen::Vector3d& w_dot) {
  const double cp = std::cos(m.pitch.q), tp = std::tan(m.pitch.q);
  if (std::abs(cp) < 1e-9) return;
  const double cr = std::cos(m.roll.q), sr = std::sin(m.roll.q);
  const double turning = w.y() * sr + w.z() * cr;  // yaw' cos(pitch)
  m.roll.qd = w.x() + turning * tp;
  m.yaw.qd = turning / cp;
  const double pitch_dot = w.y() * cr - w.z() * sr;
  const double turning_dot = w_dot.y() * sr + w_dot.z() * cr + m.roll.qd * pitch_dot;
  m.roll.qdd = w_dot.x() + turning_dot * tp + turning * pitch_dot / (cp * cp);
  m.yaw.qdd = (turning_dot + turning * tp * pitch_dot) / cp;
}

}  // namespace

Eigen::Vector3d inHeading(const Eigen::Vector3d& v, double yaw) {
  if (yaw == 0.0) return v;
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {c * v.x() + s * v.y(), c * v.y() - s * v.x(), v.z()};
}

HeadingMotion headingMotion(const BodyState& body) {
  HeadingMotion m;
  m.pitch = body.pitch;
  if (!onlyPitches(body)) {
    const Eigen::Vector3d angles = rollPitchYaw(body.R_IB());
    m.roll.q = angles.x();
    m.yaw.q = angles.z();
    setRates(m, body.Omega_B, body.Omega_dot_B);
  }
  m.velocity = inHeading(body.v, m.yaw.q);
  m.velocity_dot = inHeading(body.a, m.yaw.q);
  m.velocity_dot.x() += m.yaw.qd * m.velocity.y();
  m.velocity_dot.y() -= m.yaw.qd * m.velocity.x();
  return m;
}

}  // namespace monarch_flight
