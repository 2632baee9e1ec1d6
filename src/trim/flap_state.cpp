#include "monarch_flight/trim/flap_state.h"

#include "monarch_flight/insect/heading.h"

namespace monarch_flight {

FlapState trimScales() {
  FlapState scales;
  scales << 0.1, 0.1, 0.1, 5.0, 0.1, 10.0, 0.1, 0.1, 5.0, 5.0, 0.1, 10.0;
  return scales;
}

bool inPlane(const FlapState& s) {
  return s.segment<4>(kInPlaneStates).isZero(0.0) && s.tail<2>() == s.segment<2>(4);
}

FlapState flapState(const Interface& at) {
  const HeadingMotion body = headingMotion(at.body);
  FlapState s;
  s << body.velocity.x(), body.velocity.z(), body.pitch.q, body.pitch.qd, at.theta.right.q,
      at.theta.right.qd, body.velocity.y(), body.roll.q, body.roll.qd, body.yaw.qd, at.theta.left.q,
      at.theta.left.qd;
  return s;
}

FlapState flapRates(const Interface& at) {
  const HeadingMotion body = headingMotion(at.body);
  FlapState a;
  a << body.velocity_dot.x(), body.velocity_dot.z(), body.pitch.qd, body.pitch.qdd,
      at.theta.right.qd, at.theta.right.qdd, body.velocity_dot.y(), body.roll.qd, body.roll.qdd,
      body.yaw.qdd, at.theta.left.qd, at.theta.left.qdd;
  return a;
}

StartValues startOf(const FreeCoordinates& free, const Eigen::Vector3d& place, const FlapState& s,
                    const FlapState& a) {
  StartValues start;
  // The axes turn: what they add to the rates is taken off.
  if (free[kX]) start.x = StartValue{place.x(), s(0), a(0) - s(9) * s(6)};
  if (free[kY]) start.y = StartValue{place.y(), s(6), a(6) + s(9) * s(0)};
  if (free[kZ]) start.z = StartValue{place.z(), s(1), a(1)};
  if (free[kPitch]) start.pitch = StartValue{s(2), s(3), a(3)};
  if (free[kRoll]) start.roll = StartValue{s(7), s(8), a(8)};
  if (free[kYaw]) start.yaw = StartValue{0.0, s(9), a(9)};
  if (free[kThetaR]) start.theta_R = StartValue{s(4), s(5), a(5)};
  if (free[kThetaL]) start.theta_L = StartValue{s(10), s(11), a(11)};
  return start;
}

}  // namespace monarch_flight
