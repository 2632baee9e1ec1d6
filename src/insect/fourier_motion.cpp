#include "monarch_flight/insect/fourier_motion.h"

#include <algorithm>
#include <cmath>

namespace monarch_flight {
namespace {

void addSway(BodyState& body, int axis, const Coordinate& sway) {
  body.x[axis] += sway.q;
  body.v[axis] += sway.qd;
  body.a[axis] += sway.qdd;
}

}  // namespace

Coordinate FourierSeries::at(double frequency, double t) const {
  Coordinate sum{a0, 0.0, 0.0};
  const std::size_t terms = std::max(an.size(), bn.size());
  for (std::size_t i = 0; i < terms; ++i) {
    const double a = i < an.size() ? an[i] : 0.0;
    const double b = i < bn.size() ? bn[i] : 0.0;
    const double w = 2.0 * M_PI * frequency * multiple * static_cast<double>(i + 1);
    const double c = std::cos(w * t);
    const double s = std::sin(w * t);
    sum.q += a * c + b * s;
    sum.qd += w * (b * c - a * s);
    sum.qdd -= w * w * (a * c + b * s);
  }
  return sum;
}

PrescribedState FourierMotion::at(double t) const {
  const double f = settings_.frequency;
  PrescribedState state;
  state.body.x = settings_.position + settings_.velocity * t;
  state.body.v = settings_.velocity;
  addSway(state.body, 0, settings_.sway_x.at(f, t));
  addSway(state.body, 2, settings_.sway_z.at(f, t));
  state.body = withPitch(state.body, settings_.pitch.at(f, t));
  const WingAngles wing{settings_.phi.at(f, t), settings_.psi.at(f, t), settings_.theta.at(f, t)};
  state.angles = {{wing, wing}, settings_.theta_A.at(f, t)};
  return state;
}

}  // namespace monarch_flight
