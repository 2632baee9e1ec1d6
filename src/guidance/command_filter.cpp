#include "monarch_flight/guidance/command_filter.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace monarch_flight {

void CommandFilter::reset() {
  u_ = integral_ = 0.0;
  x_ = {};
}

void CommandFilter::advance(double command, double dt) {
  const double distance = command - u_;
  if (distance == 0.0 && x_.q == u_ && x_.qd == 0.0 && x_.qdd == 0.0) {  // at rest, to the last bit
    integral_ += u_ * dt;
    return;
  }
  const double underway = std::min(dt, std::abs(distance) / rate_);
  if (underway > 0.0) ramp(std::copysign(rate_, distance), underway);
  if (underway < dt) {
    u_ = command;
    ramp(0.0, dt - underway);
  }
}

/// Exact solution while the target goes straight, u = u_ + slope t. With e = x - (u - 3 slope / w),
/// the distance from the stationary solution: e = (c0 + c1 t + c2 t^2) exp(-w t).
void CommandFilter::ramp(double slope, double dt) {
  const double w = w_;
  const double e0 = x_.q - (u_ - 3.0 * slope / w), e1 = x_.qd - slope, e2 = x_.qdd;
  const double c0 = e0, c1 = e1 + w * e0, c2 = 0.5 * (e2 + 2.0 * w * e1 + w * w * e0);
  const double decay = std::exp(-w * dt);
  const double p = c0 + dt * (c1 + dt * c2), pd = c1 + 2.0 * dt * c2, pdd = 2.0 * c2;
  const Coordinate before = x_;
  const double target = u_ + slope * dt;
  x_.q = target - 3.0 * slope / w + p * decay;
  x_.qd = slope + (pd - w * p) * decay;
  x_.qdd = (pdd - 2.0 * w * pd + w * w * p) * decay;
  // The equation, integrated: w^3 (int u - int x) = [x'' + 3 w x' + 3 w^2 x].
  const double change =
      (x_.qdd - before.qdd) + 3.0 * w * (x_.qd - before.qd) + 3.0 * w * w * (x_.q - before.q);
  integral_ += 0.5 * (u_ + target) * dt - change / (w * w * w);
  u_ = target;
}

void CommandFilter::memory(StateVisitor& state, const char* name) {
  Eigen::Matrix<double, 5, 1> values;
  values << u_, x_.q, x_.qd, x_.qdd, integral_;
  state(name, values);
  if (!state.loading()) return;
  u_ = values[0];
  x_ = {values[1], values[2], values[3]};
  integral_ = values[4];
}

}  // namespace monarch_flight
