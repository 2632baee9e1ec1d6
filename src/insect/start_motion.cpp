#include "monarch_flight/insect/start_motion.h"

#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

void setComponent(BodyState& body, int i, const Coordinate& value) {
  body.x[i] = value.q;
  body.v[i] = value.qd;
  body.a[i] = value.qdd;
}

}  // namespace

PrescribedState StartMotion::at(double t) const {
  PrescribedState state = base_->at(t);
  const double elapsed = t - t_start_;
  if (start_.x) setComponent(state.body, 0, start_.x->at(elapsed));
  if (start_.y) setComponent(state.body, 1, start_.y->at(elapsed));
  if (start_.z) setComponent(state.body, 2, start_.z->at(elapsed));
  if (start_.pitch) state.body = withPitch(state.body, start_.pitch->at(elapsed));
  if (start_.attitude) {
    BodyState& body = state.body;
    body.R_IB = start_.attitude->R_IB * expSO3(elapsed * start_.attitude->Omega_B);
    body.Omega_B = start_.attitude->Omega_B;
    body.Omega_dot_B.setZero();
    setPitchAngle(body);
  }
  if (start_.theta_R) {
    for (Side side : kSides) state.angles.wings[side].theta = start_.theta_R->at(elapsed);
  }
  return state;
}

}  // namespace monarch_flight
