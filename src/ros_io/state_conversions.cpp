#include "monarch_flight/ros_io/state_conversions.h"

#include "monarch_flight/coupling/interface_values.h"
#include "ros_io/geometry.h"

namespace monarch_flight {

JointMotion toMessage(const Coordinate& coordinate) {
  JointMotion out;
  out.position = coordinate.q;
  out.velocity = coordinate.qd;
  out.acceleration = coordinate.qdd;
  return out;
}

BodyMotion toMessage(const BodyState& body) {
  BodyMotion out;
  out.position = toPoint(body.x);
  out.orientation = sameQuaternion(body.q_IB);
  out.velocity = toVector3(body.v);
  out.acceleration = toVector3(body.a);
  out.angular_velocity = toVector3(body.Omega_B);
  out.angular_acceleration = toVector3(body.Omega_dot_B);
  out.pitch = toMessage(body.pitch);
  return out;
}

BodyState fromMessage(const BodyMotion& body) {
  BodyState out;
  out.x = vector(body.position);
  out.q_IB = quaternion(body.orientation);
  out.v = vector(body.velocity);
  out.a = vector(body.acceleration);
  out.Omega_B = vector(body.angular_velocity);
  out.Omega_dot_B = vector(body.angular_acceleration);
  out.pitch = coordinate(body.pitch);
  return out;
}

WingJoints toMessage(const WingAngles& angles, double rest_angle) {
  WingJoints out;
  out.phi = toMessage(angles.phi);
  out.psi = toMessage(angles.psi);
  out.theta = toMessage(angles.theta);
  out.rest_angle = rest_angle;
  return out;
}

WingAngles fromMessage(const WingJoints& joints) {
  return {coordinate(joints.phi), coordinate(joints.psi), coordinate(joints.theta)};
}

InterfaceState toMessage(const Interface& interface) {
  InterfaceState out;
  out.body = toMessage(interface.body);
  out.theta_right = toMessage(interface.theta.right);
  out.theta_left = toMessage(interface.theta.left);
  return out;
}

Interface fromMessage(const InterfaceState& interface) {
  return {fromMessage(interface.body),
          {coordinate(interface.theta_right), coordinate(interface.theta_left)}};
}

WingLoads toMessage(const Loads& loads) {
  WingLoads out;
  out.pressure = wrench(loads.force_pressure, loads.moment_pressure);
  out.friction = wrench(loads.force_friction, loads.moment_friction);
  return out;
}

Loads fromMessage(const WingLoads& loads) {
  return {vector(loads.pressure.force), vector(loads.friction.force), vector(loads.pressure.torque),
          vector(loads.friction.torque)};
}

PrescribedLevel toMessage(const PrescribedState& prescribed) {
  const auto& [wings, theta_A] = prescribed.angles;
  PrescribedLevel out;
  out.body = toMessage(prescribed.body);
  out.right_wing = toMessage(wings.right, prescribed.rest_angle.right);
  out.left_wing = toMessage(wings.left, prescribed.rest_angle.left);
  out.theta_a = toMessage(theta_A);
  out.wind = toVector3(prescribed.wind.v);
  out.wind_change = toVector3(prescribed.wind.a);
  return out;
}

PrescribedState fromMessage(const PrescribedLevel& prescribed) {
  PrescribedState out;
  out.body = fromMessage(prescribed.body);
  out.angles.wings = {fromMessage(prescribed.right_wing), fromMessage(prescribed.left_wing)};
  out.angles.theta_A = coordinate(prescribed.theta_a);
  out.rest_angle = {prescribed.right_wing.rest_angle, prescribed.left_wing.rest_angle};
  out.wind = {vector(prescribed.wind), vector(prescribed.wind_change)};
  return out;
}

bool finite(const Interface& interface) { return interfaceValues(interface).allFinite(); }

}  // namespace monarch_flight
