// A flight is held to a share of real time.
#include <gtest/gtest.h>

#include "monarch_flight/run/pace.h"

namespace monarch_flight {
namespace {

using std::chrono::milliseconds;

TEST(Pace, WithoutARateNothingIsHeldUp) {
  Pace pace(0.0, 0.01);
  const Pace::Clock::time_point now = Pace::Clock::now();
  pace.begin(1, now);
  EXPECT_LE(pace.left(now).count(), 0);
}

TEST(Pace, AStepTakesItsShareOfWallTime) {
  Pace pace(0.1, 0.01);  // 0.1 s of wall time a step
  Pace::Clock::time_point now = Pace::Clock::now();
  const Pace::Clock::time_point begin = now;
  for (std::uint32_t step = 1; step <= 20; ++step) {
    now += std::max(pace.left(now), Pace::Clock::duration(0)) + milliseconds(7);  // waits end late
    pace.begin(step, now);
  }
  EXPECT_GE(now - begin, milliseconds(19 * 100 - 50));
  EXPECT_LE(now - begin, milliseconds(19 * 100 + 14));
}

TEST(Pace, WhatAPauseCostIsNotCaughtUpWith) {
  Pace pace(0.1, 0.01);
  Pace::Clock::time_point now = Pace::Clock::now();
  pace.begin(1, now);
  now += std::chrono::seconds(60);
  pace.begin(2, now);
  EXPECT_GE(pace.left(now), milliseconds(49));
}

TEST(Pace, AStepThatIsAskedForTwiceCountsOnce) {
  Pace pace(0.1, 0.01);
  const Pace::Clock::time_point now = Pace::Clock::now();
  pace.begin(1, now);
  const auto left = pace.left(now);
  pace.begin(1, now);
  EXPECT_EQ(left, pace.left(now));
}

TEST(Pace, ATinyRateIsNoOverflow) {
  Pace pace(1e-300, 0.01);
  const Pace::Clock::time_point now = Pace::Clock::now();
  pace.begin(1, now);
  EXPECT_GT(pace.left(now), std::chrono::hours(23));
}

}  // namespace
}  // namespace monarch_flight
