#include "monarch_flight/insect/start_motion.h"

#include <cmath>

#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

void setComponent(BodyState& body, int i, const Coordinate& value) {
  body.x[i] = value.q;
  body.v[i] = value.qd;
  body.a[i] = value.qdd;
}

}  // namespace

BodyState withAngles(BodyState body, const Coordinate& roll, const Coordinate& pitch,
                     const Coordinate& yaw) {
  const double cr = std::cos(roll.q), sr = std::sin(roll.q);
  const double cp = std::cos(pitch.q), sp = std::sin(pitch.q);
  body.pitch = pitch;
  body.q_IB = quaternionZ(yaw.q) * quaternionY(pitch.q) * quaternionX(roll.q);
  body.Omega_B = {roll.qd - yaw.qd * sp, pitch.qd * cr + yaw.qd * sr * cp,
                  yaw.qd * cp * cr - pitch.qd * sr};
  body.Omega_dot_B = {roll.qdd - yaw.qdd * sp - yaw.qd * pitch.qd * cp,
                      pitch.qdd * cr - pitch.qd * roll.qd * sr + yaw.qdd * sr * cp +
                          yaw.qd * roll.qd * cr * cp - yaw.qd * pitch.qd * sr * sp,
                      yaw.qdd * cp * cr - yaw.qd * pitch.qd * sp * cr - yaw.qd * roll.qd * cp * sr -
                          pitch.qdd * sr - pitch.qd * roll.qd * cr};
  return body;
}

PrescribedState StartMotion::at(double t) const {
  PrescribedState state = base_->at(t);
  const double elapsed = t - t_start_;
  if (start_.x) setComponent(state.body, 0, start_.x->at(elapsed));
  if (start_.y) setComponent(state.body, 1, start_.y->at(elapsed));
  if (start_.z) setComponent(state.body, 2, start_.z->at(elapsed));
  if (start_.pitch) state.body = withPitch(state.body, start_.pitch->at(elapsed));
  if (start_.roll || start_.yaw) {
    const Coordinate roll = start_.roll ? start_.roll->at(elapsed) : Coordinate();
    const Coordinate yaw = start_.yaw ? start_.yaw->at(elapsed) : Coordinate();
    state.body = withAngles(state.body, roll, state.body.pitch, yaw);
  }
  if (start_.theta_R) {
    for (Side side : kSides) state.angles.wings[side].theta = start_.theta_R->at(elapsed);
  }
  if (start_.theta_L) state.angles.wings.left.theta = start_.theta_L->at(elapsed);
  return state;
}

}  // namespace monarch_flight
