// The torque law of the hinge with its additions, against exact solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "monarch_flight/wing/hinge.h"

namespace monarch_flight {
namespace {

constexpr double kInertia = 2.5;

Wing wingWith(double kappa, const HingeAdditions& additions) {
  return {Appendage(), Planform::rectangle(1.0, 1.0, 0.0), kappa, 0.3, additions};
}

HingeAdditions everything() {
  HingeAdditions all;
  all.damping = 0.4;
  all.cubic_stiffness = 7.0;
  all.stop_low = -0.2;
  all.stop_high = 0.9;
  all.stop_stiffness = 30.0;
  return all;
}

Newmark every(double dt) {
  Newmark newmark;
  newmark.dt = dt;
  return newmark;
}

/// The motion under a constant moment, from `theta` at rest or not, over `steps` steps.
Coordinate after(const Hinge& hinge, Coordinate theta, double duration, int steps,
                 double moment = 0.0, const std::function<void(const Coordinate&)>& see = {}) {
  const Newmark newmark = every(duration / steps);
  theta.qdd = hinge.acceleration(kInertia, moment, theta, 0.0);
  for (int i = 0; i < steps; ++i) {
    theta = hinge.step(newmark, theta, kInertia, moment, 0.0);
    if (see) see(theta);
  }
  return theta;
}

/// Of an exact end, in angle and rate times `time`.
double error(const Coordinate& end, double q, double qd, double time) {
  return std::hypot(end.q - q, (end.qd - qd) * time);
}

TEST(Hinge, WithoutAdditionsIsTheLinearSpring) {
  const Hinge hinge(wingWith(4.0, {}));
  EXPECT_DOUBLE_EQ(hinge.torque(0.8, 5.0, 0.1), -4.0 * (0.8 - 0.4));
  EXPECT_DOUBLE_EQ(hinge.stiffness(0.8, 0.1), 4.0);
  const Newmark newmark = every(0.2);
  const Coordinate n{0.7, -0.4, 0.9};
  const Coordinate next = hinge.step(newmark, n, kInertia, 1.5, 0.1);
  EXPECT_NEAR(next.qdd, (1.5 - 4.0 * (next.q - 0.4)) / kInertia, 1e-15);
}

TEST(Hinge, TorqueIsTheSumOfItsParts) {
  const Hinge hinge(wingWith(4.0, everything()));
  const auto expected = [](double theta, double rate, double stop) {
    const double e = theta - 0.4;
    return -4.0 * e - 7.0 * e * e * e - 0.4 * rate - 30.0 * stop;
  };
  EXPECT_NEAR(hinge.torque(0.6, 2.0, 0.1), expected(0.6, 2.0, 0.0), 1e-14);
  EXPECT_NEAR(hinge.torque(1.1, 2.0, 0.1), expected(1.1, 2.0, 0.2), 1e-14);
  EXPECT_NEAR(hinge.torque(-0.5, -2.0, 0.1), expected(-0.5, -2.0, -0.3), 1e-14);
}

TEST(Hinge, StiffnessIsTheSlopeOfTheTorque) {
  const Hinge hinge(wingWith(4.0, everything()));
  const double d = 1e-6;
  for (double theta : {-0.7, -0.1, 0.4, 0.8, 1.3}) {
    const double slope = (hinge.torque(theta + d, 0.0, 0.1) - hinge.torque(theta - d, 0.0, 0.1));
    EXPECT_NEAR(hinge.stiffness(theta, 0.1), -slope / (2.0 * d), 1e-7);
  }
}

TEST(Hinge, StepSolvesTheEquationAtTheNewAngle) {
  const Hinge hinge(wingWith(4.0, everything()));
  for (double moment : {-60.0, -3.0, 0.0, 5.0, 80.0}) {
    for (double dt : {0.01, 0.3, 3.0}) {
      const Coordinate next = hinge.step(every(dt), {0.7, -0.4, 0.9}, kInertia, moment, 0.1);
      const double there = hinge.acceleration(kInertia, moment, next, 0.1);
      EXPECT_NEAR(next.qdd, there, 1e-11 * (1.0 + std::abs(moment))) << moment << ' ' << dt;
    }
  }
}

/// kappa e + cubic e^3 = M, by Cardano's formula.
TEST(Hinge, ComesToRestInStaticEquilibrium) {
  HingeAdditions additions;
  additions.damping = 6.0;
  additions.cubic_stiffness = 7.0;
  const double kappa = 4.0, moment = 5.0, p = kappa / 7.0, q = moment / 7.0;
  const double root = std::sqrt(0.25 * q * q + p * p * p / 27.0);
  const double exact = std::cbrt(0.5 * q + root) + std::cbrt(0.5 * q - root);
  const Coordinate end =
      after(Hinge(wingWith(kappa, additions)), {0.3, 0.0, 0.0}, 60.0, 2000, moment);
  EXPECT_NEAR(end.q - 0.3, exact, 1e-10);
  EXPECT_NEAR(end.qd, 0.0, 1e-10);
}

/// Duffing's oscillator: the period from e = A at rest is 4 K(k) / sqrt(a + b A^2), a = kappa / J,
/// b = cubic / J, k^2 = b A^2 / (2 (a + b A^2)).
TEST(Hinge, StiffeningSpringHasTheExactPeriodWithSecondOrder) {
  HingeAdditions additions;
  additions.cubic_stiffness = 7.0;
  const double a = 4.0 / kInertia, b = 7.0 / kInertia, A = 1.2, sum = a + b * A * A;
  const double period = 4.0 * std::comp_ellint_1(std::sqrt(0.5 * b * A * A / sum)) / std::sqrt(sum);
  const Hinge hinge(wingWith(4.0, additions));
  const auto missed = [&](int steps) {
    return error(after(hinge, {0.3 + A, 0.0, 0.0}, period, steps), 0.3 + A, 0.0, period);
  };
  EXPECT_LT(missed(800), 1e-3);
  EXPECT_NEAR(missed(200) / missed(400), 4.0, 0.1);
  EXPECT_NEAR(missed(400) / missed(800), 4.0, 0.05);
}

TEST(Hinge, StiffeningSpringKeepsTheEnergy) {
  HingeAdditions additions;
  additions.cubic_stiffness = 7.0;
  const Hinge hinge(wingWith(4.0, additions));
  const auto drift = [&](int steps) {
    const auto energy = [](const Coordinate& theta) {
      const double e = theta.q - 0.3;
      return 0.5 * kInertia * theta.qd * theta.qd + 2.0 * e * e + 7.0 / 4.0 * e * e * e * e;
    };
    const double start = energy({1.5, 0.0, 0.0});
    double largest = 0.0;
    after(hinge, {1.5, 0.0, 0.0}, 50.0, steps, 0.0, [&](const Coordinate& theta) {
      largest = std::max(largest, std::abs(energy(theta) / start - 1.0));
    });
    return largest;
  };
  EXPECT_LT(drift(20000), 1e-5);
  EXPECT_NEAR(drift(10000) / drift(20000), 4.0, 0.1);
}

/// e = A exp(-d t) (cos w t + d / w sin w t), d = c / (2 J), w^2 = kappa / J - d^2.
TEST(Hinge, DamperDecaysExactlyWithSecondOrder) {
  HingeAdditions additions;
  additions.damping = 0.4;
  const double d = 0.4 / (2.0 * kInertia), w = std::sqrt(4.0 / kInertia - d * d), t = 12.0;
  const double shrunk = 0.2 * std::exp(-d * t);
  const double q = 0.3 + shrunk * (std::cos(w * t) + d / w * std::sin(w * t));
  const double qd = -shrunk * (w + d * d / w) * std::sin(w * t);
  const Hinge hinge(wingWith(4.0, additions));
  const auto missed = [&](int steps) {
    return error(after(hinge, {0.5, 0.0, 0.0}, t, steps), q, qd, 1.0 / w);
  };
  EXPECT_LT(missed(1600), 2e-4 * shrunk);
  EXPECT_NEAR(missed(400) / missed(800), 4.0, 0.05);
  EXPECT_NEAR(missed(800) / missed(1600), 4.0, 0.05);
}

/// What the damper takes is what the spring and the motion lose.
TEST(Hinge, DamperTakesTheEnergyThatIsMissing) {
  HingeAdditions additions = everything();
  const Hinge hinge(wingWith(4.0, additions));
  const auto energy = [](const Coordinate& theta) {
    const double e = theta.q - 0.3, beyond = theta.q - std::clamp(theta.q, -0.2, 0.9);
    return 0.5 * kInertia * theta.qd * theta.qd + 2.0 * e * e + 7.0 / 4.0 * e * e * e * e +
           15.0 * beyond * beyond;
  };
  const Coordinate start{1.3, 0.0, 0.0};
  const double duration = 8.0;
  const int steps = 40000;
  double taken = 0.0, rate = 0.0;
  const Coordinate end = after(hinge, start, duration, steps, 0.0, [&](const Coordinate& theta) {
    taken += 0.5 * (rate * rate + theta.qd * theta.qd) * additions.damping * duration / steps;
    rate = theta.qd;
  });
  EXPECT_GT(taken, 0.5 * energy(start));
  EXPECT_NEAR(energy(end) + taken, energy(start), 1e-5 * energy(start));
}

/// Thrown against a stop the wing stays half a swing of the stop's spring, and comes back as fast.
TEST(Hinge, StopThrowsTheWingBack) {
  HingeAdditions additions;
  additions.stop_high = 0.9;
  additions.stop_stiffness = 30.0;
  const double rate = 0.8, reach = 0.1 / rate;
  const double inside = M_PI * std::sqrt(kInertia / 30.0);
  double deepest = 0.0;
  const Coordinate end =
      after(Hinge(wingWith(0.0, additions)), {0.8, rate, 0.0}, 2.0 * reach + inside, 20000, 0.0,
            [&](const Coordinate& theta) { deepest = std::max(deepest, theta.q - 0.9); });
  EXPECT_NEAR(end.q, 0.8, 1e-5);
  EXPECT_NEAR(end.qd, -rate, 1e-5);
  EXPECT_NEAR(deepest, rate * std::sqrt(kInertia / 30.0), 1e-5);
}

}  // namespace
}  // namespace monarch_flight
