// What guidance prescribes and commands, as messages.
#include "monarch_flight/ros_io/conversions.h"

namespace monarch_flight {
namespace {

JointMotion joint(const Coordinate& c) {
  JointMotion out;
  out.position = c.q;
  out.velocity = c.qd;
  out.acceleration = c.qdd;
  return out;
}

Coordinate coordinate(const JointMotion& joint) {
  return {joint.position, joint.velocity, joint.acceleration};
}

geometry_msgs::Vector3 vector3(const Eigen::Vector3d& v) {
  geometry_msgs::Vector3 out;
  out.x = v.x();
  out.y = v.y();
  out.z = v.z();
  return out;
}

Eigen::Vector3d vector(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

}  // namespace

PrescribedLevel toMessage(const PrescribedState& prescribed) {
  PrescribedLevel out;
  out.interface = toMessage(prescribed.interface());
  const auto& [right, left] = prescribed.angles.wings;
  out.phi = joint(right.phi);
  out.psi = joint(right.psi);
  out.phi_l = joint(left.phi);
  out.psi_l = joint(left.psi);
  out.theta_a = joint(prescribed.angles.theta_A);
  out.rest_angle = prescribed.rest_angle.right;
  out.rest_angle_l = prescribed.rest_angle.left;
  out.wind = vector3(prescribed.wind.v);
  out.wind_change = vector3(prescribed.wind.a);
  return out;
}

PrescribedState fromMessage(const PrescribedLevel& prescribed) {
  const Interface interface = fromMessage(prescribed.interface);
  PrescribedState out;
  out.body = interface.body;
  out.angles.wings = {
      {coordinate(prescribed.phi), coordinate(prescribed.psi), interface.theta.right},
      {coordinate(prescribed.phi_l), coordinate(prescribed.psi_l), interface.theta.left}};
  out.angles.theta_A = coordinate(prescribed.theta_a);
  out.rest_angle = {prescribed.rest_angle, prescribed.rest_angle_l};
  out.wind = {vector(prescribed.wind), vector(prescribed.wind_change)};
  return out;
}

WingbeatCommand toMessage(const WingbeatChange& change) {
  WingbeatCommand out;
  out.differential_amplitude = change.differential_amplitude;
  out.differential_flapping = change.differential_flapping;
  out.differential_deviation = change.differential_deviation;
  out.differential_rest_angle = change.differential_rest_angle;
  out.amplitude = change.amplitude;
  out.flapping_mean = change.flapping_mean;
  out.frequency = change.frequency;
  out.deviation_mean = change.deviation_mean;
  out.rest_angle = change.rest_angle;
  out.abdomen_mean = change.abdomen_mean;
  out.abdomen_amplitude = change.abdomen_amplitude;
  return out;
}

WingbeatChange fromMessage(const WingbeatCommand& command) {
  return {command.amplitude,
          command.flapping_mean,
          command.frequency,
          command.deviation_mean,
          command.rest_angle,
          command.abdomen_mean,
          command.abdomen_amplitude,
          command.differential_amplitude,
          command.differential_flapping,
          command.differential_deviation,
          command.differential_rest_angle};
}

GuidanceState toMessage(const GuidanceReport& report) {
  GuidanceState out;
  out.command = toMessage(report.command);
  out.applied = toMessage(report.applied);
  out.phase = report.phase;
  out.clipped = report.clipped;
  out.refused = report.refused;
  out.lost = report.lost;
  return out;
}

}  // namespace monarch_flight
