// The filter behind a command: against its differential equation, and what it promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "monarch_flight/coupling/state_visitor.h"
#include "monarch_flight/guidance/command_filter.h"

namespace monarch_flight {
namespace {

constexpr double kTau = 0.025, kRate = 20.0, kPeriod = 0.1;

/// The filter's equation and the target's, by Runge-Kutta in many small steps: (x, x', x'', u, int
/// x).
std::array<double, 5> integrated(std::array<double, 5> s, double command, double dt) {
  constexpr int kSteps = 20000;
  const double w = 1.0 / kTau, h = dt / kSteps;
  const auto rate = [&](const std::array<double, 5>& y) {
    return std::array<double, 5>{
        y[1], y[2], w * w * w * (y[3] - y[0]) - 3.0 * w * w * y[1] - 3.0 * w * y[2], 0.0, y[0]};
  };
  for (int i = 0; i < kSteps; ++i) {
    const double u = s[3],
                 step = std::copysign(std::min(kRate * h, std::abs(command - u)), command - u);
    std::array<double, 5> k1 = rate(s), y = s;
    for (int j = 0; j < 5; ++j) y[j] = s[j] + 0.5 * h * k1[j];
    y[3] = u + 0.5 * step;
    const std::array<double, 5> k2 = rate(y);
    for (int j = 0; j < 5; ++j) y[j] = s[j] + 0.5 * h * k2[j];
    y[3] = u + 0.5 * step;
    const std::array<double, 5> k3 = rate(y);
    for (int j = 0; j < 5; ++j) y[j] = s[j] + h * k3[j];
    y[3] = u + step;
    const std::array<double, 5> k4 = rate(y);
    for (int j = 0; j < 5; ++j) s[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
    s[3] = u + step;
  }
  return s;
}

TEST(CommandFilter, SolvesItsEquationExactlyInStepsOfAnyLength) {
  CommandFilter filter(kTau, kRate);
  std::array<double, 5> exact{};
  const double commands[] = {0.3, 0.3, -0.5, -0.5, 0.1, 0.0},
               steps[] = {0.004, 0.05, 0.01, 0.1, 0.002, 0.3};
  for (int i = 0; i < 6; ++i) {
    filter.advance(commands[i], steps[i]);
    exact = integrated(exact, commands[i], steps[i]);
    EXPECT_NEAR(filter.value().q, exact[0], 1e-8) << i;
    EXPECT_NEAR(filter.value().qd, exact[1], 1e-6) << i;
    EXPECT_NEAR(filter.value().qdd, exact[2], 1e-4) << i;
    EXPECT_NEAR(filter.integral(), exact[4], 1e-9) << i;
  }
}

TEST(CommandFilter, IsTheSameInOneStepOrInMany) {
  CommandFilter once(kTau, kRate), often(kTau, kRate);
  once.advance(0.4, 0.06);
  for (int i = 0; i < 600; ++i) often.advance(0.4, 1e-4);
  EXPECT_NEAR(once.value().q, often.value().q, 1e-13);
  EXPECT_NEAR(once.value().qd, often.value().qd, 1e-11);
  EXPECT_NEAR(once.value().qdd, often.value().qdd, 1e-8);
  EXPECT_NEAR(once.integral(), often.integral(), 1e-14);
}

/// Commands that jump at will: between the commands given, slower than the rate, C2.
TEST(CommandFilter, StaysBetweenTheCommandsAndBelowTheRate) {
  CommandFilter filter(kTau, 2.0);
  const double w = 1.0 / kTau, dt = 1e-4;
  unsigned random = 1;
  double command = 0.0;
  Coordinate before = filter.value();
  for (int i = 0; i < 100000; ++i) {
    if (i % 97 == 0) {
      random = random * 1664525u + 1013904223u;
      command = (random >> 8) / static_cast<double>(1 << 24) - 0.5;
    }
    filter.advance(command, dt);
    const Coordinate& now = filter.value();
    ASSERT_LE(std::abs(now.q), 0.5);
    ASSERT_LE(std::abs(now.qd), 2.0 + 1e-12);
    // |x'''| <= w^3 |u - x| + ... is bounded, so x'' cannot jump.
    ASSERT_LE(std::abs(now.qdd - before.qdd), dt * 8.0 * w * w * 2.0);
    before = now;
  }
}

TEST(CommandFilter, SettlesOnTheCommandAndStaysAtRestToTheBit) {
  CommandFilter filter(kTau, kRate);
  for (int i = 0; i < 10; ++i) filter.advance(0.0, 1e-3);
  EXPECT_EQ(filter.value().q, 0.0);
  EXPECT_EQ(filter.integral(), 0.0);
  for (int i = 0; i < 2000; ++i) filter.advance(0.2, 1e-3);
  EXPECT_NEAR(filter.value().q, 0.2, 1e-14);
  EXPECT_NEAR(filter.value().qd, 0.0, 1e-12);
}

TEST(CommandFilter, ComesBackBitForBit) {
  CommandFilter filter(kTau, kRate), other(kTau, kRate);
  filter.advance(0.3, 0.0123);
  StateSnapshot snapshot;
  snapshot.take([&](StateVisitor& s) { filter.memory(s, "f"); });
  snapshot.putBack([&](StateVisitor& s) { other.memory(s, "f"); });
  for (CommandFilter* f : {&filter, &other}) f->advance(-0.1, 0.0321);
  EXPECT_EQ(filter.value().q, other.value().q);
  EXPECT_EQ(filter.value().qdd, other.value().qdd);
  EXPECT_EQ(filter.integral(), other.integral());
}

}  // namespace
}  // namespace monarch_flight
