#include "monarch_flight/coupling/interface_values.h"

#include <cmath>

namespace monarch_flight {
namespace {

Eigen::Vector3d triple(const Coordinate& c) { return {c.q, c.qd, c.qdd}; }

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
  const Quaternion& q = body.q_IB;
  InterfaceValues values;
  values << body.x, body.v, body.a, q.w(), q.x(), q.y(), q.z(), body.Omega_B, body.Omega_dot_B,
      triple(body.pitch), triple(interface.theta.right), triple(interface.theta.left);
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
  body.q_IB = Quaternion(values[9], values[10], values[11], values[12]);
  body.Omega_B = v(13);
  body.Omega_dot_B = v(16);
  body.pitch = coordinate(19);
  interface.theta = {coordinate(22), coordinate(25)};
  return interface;
}

PrescribedValues prescribedValues(const PrescribedState& prescribed) {
  const auto& [right, left] = prescribed.angles.wings;
  PrescribedValues values;
  values << interfaceValues(prescribed.interface()), triple(right.phi), triple(right.psi),
      triple(left.phi), triple(left.psi), triple(prescribed.angles.theta_A),
      prescribed.rest_angle.right, prescribed.rest_angle.left, prescribed.wind.v, prescribed.wind.a;
  return values;
}

PrescribedState prescribedOf(const PrescribedValues& values) {
  const auto coordinate = [&values](int first) {
    return Coordinate{values[first], values[first + 1], values[first + 2]};
  };
  const Interface interface = interfaceOf(values.head<28>());
  PrescribedState prescribed;
  prescribed.body = interface.body;
  prescribed.angles.wings = {{coordinate(28), coordinate(31), interface.theta.right},
                             {coordinate(34), coordinate(37), interface.theta.left}};
  prescribed.angles.theta_A = coordinate(40);
  prescribed.rest_angle = {values[43], values[44]};
  prescribed.wind = {values.segment<3>(45), values.segment<3>(48)};
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
         same(a.interface, b.interface) && same(a.loads.right, b.loads.right) &&
         same(a.loads.left, b.loads.left) && a.want_operator == b.want_operator &&
         a.want_surface == b.want_surface && a.block_points == b.block_points &&
         a.want_flow == b.want_flow;
}

bool isAttitude(const Quaternion& q) { return std::abs(q.squaredNorm() - 1.0) <= 1e-6; }

bool finite(const Request& request) {
  return std::isfinite(request.t) && prescribedValues(request.prescribed).allFinite() &&
         interfaceValues(request.interface).allFinite() && finite(request.loads.right) &&
         finite(request.loads.left);
}

bool finite(const Reply& reply) {
  return interfaceValues(reply.interface).allFinite() &&
         (!reply.prescribed || prescribedValues(*reply.prescribed).allFinite()) &&
         finite(reply.loads) &&
         (!reply.jacobian ||
          (reply.jacobian->velocity.allFinite() && reply.jacobian->acceleration.allFinite()));
}

}  // namespace monarch_flight
