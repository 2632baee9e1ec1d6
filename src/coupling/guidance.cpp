#include "monarch_flight/coupling/guidance.h"

namespace monarch_flight {

Wind windAhead(const WindModel& wind, const GuidanceInput& input) {
  const BodyState& n = input.interface.body;
  const Eigen::Vector3d v = n.v + input.dt * n.a;
  return wind.at(input.t, n.x + 0.5 * input.dt * (n.v + v), v, n.a);
}

PrescribedState MotionGuidance::start(double t) {
  t_ = t;
  PrescribedState state = motion_->at(t);
  state.wind = wind_->at(t, state.body.x, state.body.v, state.body.a);
  return state;
}

GuidanceReport MotionGuidance::report() const {
  GuidanceReport report;
  report.phase = frequency_ * t_;
  return report;
}

PrescribedState MotionGuidance::next(const GuidanceInput& input) {
  t_ = input.t;
  PrescribedState state = motion_->at(input.t);
  state.wind = windAhead(*wind_, input);
  return state;
}

}  // namespace monarch_flight
