#include "monarch_flight/wing/hinge.h"

#include <cmath>
#include <string>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

constexpr int kNewton = 50;        // steps at most; five are usual
constexpr double kSolved = 1e-13;  // of the torques at hand: where they end

}  // namespace

double Hinge::beyondStops(double theta) const {
  if (additions_.stop_high && theta > *additions_.stop_high) return theta - *additions_.stop_high;
  if (additions_.stop_low && theta < *additions_.stop_low) return theta - *additions_.stop_low;
  return 0.0;
}

double Hinge::addedTorque(double theta, double theta_dot, double rest_angle) const {
  const double e = theta - (theta_0_ + rest_angle);
  return -additions_.cubic_stiffness * e * e * e - additions_.damping * theta_dot -
         additions_.stop_stiffness * beyondStops(theta);
}

double Hinge::torque(double theta, double theta_dot, double rest_angle) const {
  return -kappa_ * (theta - (theta_0_ + rest_angle)) + addedTorque(theta, theta_dot, rest_angle);
}

double Hinge::stiffness(double theta, double rest_angle) const {
  const double e = theta - (theta_0_ + rest_angle);
  const double stop = beyondStops(theta) != 0.0 ? additions_.stop_stiffness : 0.0;
  return kappa_ + 3.0 * additions_.cubic_stiffness * e * e + stop;
}

double Hinge::acceleration(double inertia, double moment, const Coordinate& theta,
                           double rest_angle) const {
  const double spring = -kappa_ * (theta.q - (theta_0_ + rest_angle));
  if (!additions_.any()) return (moment + spring) / inertia;
  return (moment + spring + addedTorque(theta.q, theta.qd, rest_angle)) / inertia;
}

// The linear spring's step is exact; with additions it is where Newton's method starts.
Coordinate Hinge::step(const Newmark& newmark, const Coordinate& n, double inertia, double moment,
                       double rest_angle) const {
  const double unaccelerated = newmark.advance(n, 0.0).q;
  const double spring = -kappa_ * (unaccelerated - (theta_0_ + rest_angle));
  const double linear = kappa_ * newmark.beta * newmark.dt * newmark.dt;
  Coordinate next = newmark.advance(n, (moment + spring) / (inertia + linear));
  if (!additions_.any()) return next;
  for (int i = 0; i < kNewton; ++i) {
    const double spring_and_more = torque(next.q, next.qd, rest_angle);
    const double residual = inertia * next.qdd - moment - spring_and_more;
    const double slope = inertia +
                         stiffness(next.q, rest_angle) * newmark.beta * newmark.dt * newmark.dt +
                         additions_.damping * newmark.gamma * newmark.dt;
    const double change = residual / slope;
    next = newmark.advance(n, next.qdd - change);
    const double size = std::abs(inertia * next.qdd) + std::abs(moment) + std::abs(spring_and_more);
    if (inertia * std::abs(change) <= kSolved * size) return next;
  }
  throw NumericalError(
      "wing: the step of the hinge with its additions (insect/wing/hinge_additions) has no "
      "solution "
      "within " +
      std::to_string(kNewton) + " of Newton's steps; take shorter time steps or softer stops");
}

}  // namespace monarch_flight
