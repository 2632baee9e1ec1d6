#include "monarch_flight/coupling/interface_values.h"

#include <cmath>

namespace monarch_flight {
namespace {

bool same(const Loads& a, const Loads& b) {
  return a.force_pressure == b.force_pressure && a.force_friction == b.force_friction &&
         a.moment_pressure == b.moment_pressure && a.moment_friction == b.moment_friction;
}

bool finite(const Loads& loads) {
  return loads.force_pressure.allFinite() && loads.force_friction.allFinite() &&
         loads.moment_pressure.allFinite() && loads.moment_friction.allFinite();
}

}  // namespace

InterfaceValues interfaceValues(const Interface& interface) {
  const BodyState& body = interface.body;
  InterfaceValues values;
  values << body.x, body.v, body.a, body.R_IB.col(0), body.R_IB.col(1), body.R_IB.col(2),
      body.Omega_B, body.Omega_dot_B, body.pitch.q, body.pitch.qd, body.pitch.qdd,
      interface.theta_R.q, interface.theta_R.qd, interface.theta_R.qdd;
  return values;
}

Interface interfaceOf(const InterfaceValues& values) {
  const auto v = [&values](int first) { return Eigen::Vector3d(values.segment<3>(first)); };
  const auto coordinate = [&values](int first) {
    return Coordinate{values[first], values[first + 1], values[first + 2]};
  };
  Interface interface;
  BodyState& body = interface.body;
  body.x = v(0);
  body.v = v(3);
  body.a = v(6);
  for (int i = 0; i < 3; ++i) body.R_IB.col(i) = v(9 + 3 * i);
  body.Omega_B = v(18);
  body.Omega_dot_B = v(21);
  body.pitch = coordinate(24);
  interface.theta_R = coordinate(27);
  return interface;
}

PrescribedValues prescribedValues(const PrescribedState& prescribed) {
  const JointAngles& angles = prescribed.angles;
  PrescribedValues values;
  values << interfaceValues(prescribed.interface()), angles.phi.q, angles.phi.qd, angles.phi.qdd,
      angles.psi.q, angles.psi.qd, angles.psi.qdd, angles.theta_A.q, angles.theta_A.qd,
      angles.theta_A.qdd, prescribed.rest_angle, prescribed.wind.v, prescribed.wind.a;
  return values;
}

PrescribedState prescribedOf(const PrescribedValues& values) {
  const auto coordinate = [&values](int first) {
    return Coordinate{values[first], values[first + 1], values[first + 2]};
  };
  const Interface interface = interfaceOf(values.head<30>());
  PrescribedState prescribed;
  prescribed.body = interface.body;
  prescribed.angles = {coordinate(30), coordinate(33), interface.theta_R, coordinate(36)};
  prescribed.rest_angle = values[39];
  prescribed.wind = {values.segment<3>(40), values.segment<3>(43)};
  return prescribed;
}

bool same(const Interface& a, const Interface& b) {
  return interfaceValues(a) == interfaceValues(b);
}

bool same(const Coordinate& a, const Coordinate& b) {
  return a.q == b.q && a.qd == b.qd && a.qdd == b.qdd;
}

bool same(const Request& a, const Request& b) {
  return a.key == b.key && a.t == b.t &&
         prescribedValues(a.prescribed) == prescribedValues(b.prescribed) &&
         same(a.interface, b.interface) && same(a.loads, b.loads) &&
         a.want_operator == b.want_operator && a.want_fields == b.want_fields &&
         a.q_threshold == b.q_threshold && a.vortex_limit == b.vortex_limit &&
         a.want_flow == b.want_flow;
}

bool finite(const Request& request) {
  return std::isfinite(request.t) && std::isfinite(request.q_threshold) &&
         prescribedValues(request.prescribed).allFinite() &&
         interfaceValues(request.interface).allFinite() && finite(request.loads);
}

bool finite(const Reply& reply) {
  return interfaceValues(reply.interface).allFinite() &&
         (!reply.prescribed || prescribedValues(*reply.prescribed).allFinite()) &&
         finite(reply.loads) &&
         (!reply.jacobian ||
          (reply.jacobian->velocity.allFinite() && reply.jacobian->acceleration.allFinite()));
}

}  // namespace monarch_flight
