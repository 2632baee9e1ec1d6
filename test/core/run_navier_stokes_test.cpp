// Flights in Navier-Stokes air on a coarse grid: released from a prescribed motion, and with a step
// that fails.
#include <gtest/gtest.h>

#include <cmath>

#include "core/coupling_fakes.h"
#include "monarch_flight/run/federation.h"

namespace monarch_flight {
namespace {

constexpr std::size_t kFluid = static_cast<std::size_t>(Role::kFluid);

/// A fifth of a flap of climb_printed, the first twenty-fifth of it prescribed.
Case fifthOfAFlap(int steps_per_flap) {
  Case c =
      loadCase("climb_printed",
               {{"flaps", "0.2"}, {"steps_per_flap", std::to_string(steps_per_flap)}}, CONFIG_DIR);
  c.coupling.prescribed_steps = static_cast<std::uint32_t>(steps_per_flap / 25);
  c.grid.level = "custom";
  c.grid.cells_per_chord = 8;
  c.grid.first_cell = 0.08;
  c.grid.far_field = 3;
  c.grid.courant_limit = 10;
  return c;
}

/// Its steps, with answers of the fluid changed.
std::vector<CommittedStep> flown(const Case& c, std::function<void(Reply&)> change = nullptr) {
  InProcessFederation federation(c);
  Participants participants = federation.participants();
  testing::Recorder fluid(*participants[kFluid]);
  fluid.change = std::move(change);
  participants[kFluid] = &fluid;
  testing::KeepingSink sink;
  const StopFlag stop(false);
  FlyUntil control(stop);
  const RunResult result = runCase(c, 7, participants, {&sink}, control);
  EXPECT_TRUE(result.complete) << result.failure;
  return sink.steps;
}

Eigen::Vector4d endOf(const Case& c) {
  const Interface end = flown(c).back().interface;
  return {end.body.x.x(), end.body.x.z(), end.body.pitch.q, end.theta.right.q};
}

TEST(NavierStokesFlight, AReleasedFlightConvergesWithTheTimeStep) {
  const Eigen::Vector4d middle = endOf(fifthOfAFlap(200));
  const Eigen::Array4d first = endOf(fifthOfAFlap(100)) - middle;
  const Eigen::Array4d second = middle - endOf(fifthOfAFlap(400));
  const Eigen::Array4d order = (first / second).log() / std::log(2.0);
  EXPECT_GT(order.minCoeff(), 1.5) << order.transpose();
}

TEST(NavierStokesFlight, AFailedStepIsTriedAgainFromTheFlowThatWasCommitted) {
  const Case c = fifthOfAFlap(200);
  int failures = 0;
  const auto disturbed = flown(c, [&](Reply& reply) {
    if (reply.key.step == 25 && reply.key.phase == Phase::kIterate && failures++ == 0)
      reply.error = "the air broke";
  });
  const auto plain = flown(c);  // to the tolerance of the coupling, ten steps' worth
  EXPECT_GT(failures, 1);
  EXPECT_TRUE(disturbed[25].retried());
  EXPECT_FALSE(disturbed[26].retried());
  ASSERT_EQ(disturbed.size(), plain.size());
  for (std::size_t n = 0; n < plain.size(); ++n) {
    const Interface &a = disturbed[n].interface, &b = plain[n].interface;
    EXPECT_NEAR(a.theta.right.q, b.theta.right.q, 1e-7) << n;
    EXPECT_LT((a.body.x - b.body.x).norm(), 1e-7 * c.coupling.length_scale) << n;
  }
}

}  // namespace
}  // namespace monarch_flight
