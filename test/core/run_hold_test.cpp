// What people ask of a run and what its loop does meet in Hold: a loop in a thread stands for the
// coordinator.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "monarch_flight/run/hold.h"

namespace monarch_flight {
namespace {

constexpr std::uint32_t kSubIterations = 3;

/// Commits steps of three sub-iterations until the last step or until it is stopped.
class Loop {
 public:
  Loop(bool held, std::uint32_t steps) : hold(held), steps_(steps), thread_([this] { fly(); }) {}
  ~Loop() {
    stop = true;
    join();
  }
  void join() {
    if (thread_.joinable()) thread_.join();
  }

  Hold hold;
  StopFlag stop{false};
  std::atomic<std::uint32_t> evaluations{0}, starts{1}, idle_calls{0}, checkpoints{0}, kept{0};
  std::atomic<bool> slow_disk{false};

 private:
  RunControl::Order ask(std::uint32_t step, std::uint32_t iteration) {
    while (true) {
      const RunControl::Order order = hold.next(step, iteration, stop, [this](const RunPlace& p) {
        EXPECT_TRUE(p.held);
        ++idle_calls;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      });
      if (order != RunControl::Order::kCheckpoint) return order;
      kept = step - 1;
      ++checkpoints;
      while (slow_disk) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void fly() {
    for (std::uint32_t step = 1; step <= steps_; ++step) {
      for (std::uint32_t k = 0; k < kSubIterations; ++k) {
        const RunControl::Order order = ask(step, k);
        if (order == RunControl::Order::kStop) return hold.end("stopped");
        if (order == RunControl::Order::kReset) {
          ++starts;
          step = 0;
          break;
        }
        ++evaluations;
        if (k + 1 == kSubIterations) hold.committed(step);
      }
    }
    hold.end("");
  }

  std::uint32_t steps_;
  std::thread thread_;
};

TEST(Hold, HeldAtTheStartNothingIsFlown) {
  Loop loop(true, 10);
  const RunPlace place = loop.hold.pause();
  EXPECT_TRUE(place.held);
  EXPECT_EQ(0u, place.step);
  EXPECT_EQ("held after step 0", place.describe());
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(0u, loop.evaluations);
  EXPECT_GT(loop.idle_calls, 3u);
}

TEST(Hold, StepsAndSubIterationsAreCounted) {
  Loop loop(true, 100);
  loop.hold.pause();
  RunPlace place = loop.hold.steps(4);
  EXPECT_EQ(4u, place.step);
  EXPECT_EQ(0u, place.iteration);
  EXPECT_EQ(4 * kSubIterations, loop.evaluations);
  place = loop.hold.subIterate();
  EXPECT_EQ(4u, place.step);
  EXPECT_EQ(1u, place.iteration);
  EXPECT_EQ("held after step 4, sub-iteration 0 of step 5", place.describe());
  loop.hold.subIterate();
  place = loop.hold.subIterate();
  EXPECT_EQ(5u, place.step);
  EXPECT_EQ(0u, place.iteration);
  loop.hold.subIterate();
  place = loop.hold.steps(1);  // the rest of a step is a step
  EXPECT_EQ(6u, place.step);
  EXPECT_EQ(6 * kSubIterations, loop.evaluations);
}

TEST(Hold, ResumeFliesToTheEnd) {
  Loop loop(true, 10);
  loop.hold.pause();
  EXPECT_FALSE(loop.hold.resume().held);
  loop.join();
  const RunPlace place = loop.hold.place();
  EXPECT_TRUE(place.ended);
  EXPECT_EQ("the run is over: complete", place.describe());
  EXPECT_EQ(10 * kSubIterations, loop.evaluations);
}

TEST(Hold, StepsBeyondTheEndReturnWithTheEnd) {
  Loop loop(true, 3);
  loop.hold.pause();
  const RunPlace place = loop.hold.steps(0xffffffffu);
  EXPECT_TRUE(place.ended);
  EXPECT_EQ("", place.failure);
  EXPECT_EQ(3u, place.step);
}

TEST(Hold, TheLastStepCountsLikeEveryOther) {
  Loop loop(true, 50);
  loop.hold.pause();
  EXPECT_EQ(49u, loop.hold.steps(49).step);
  loop.hold.subIterate();  // in the middle of the last one
  const RunPlace place = loop.hold.steps(1);
  EXPECT_EQ(50u, place.step);
  EXPECT_EQ(0u, place.iteration);
  EXPECT_TRUE(place.ended);
}

TEST(Hold, AFlyingRunRefusesSingleSteps) {
  Loop loop(false, 4000000000u);
  EXPECT_FALSE(loop.hold.steps(2).held);
  EXPECT_FALSE(loop.hold.subIterate().held);
  EXPECT_TRUE(loop.hold.pause().held);
}

TEST(Hold, FlyUntilHoldsBehindThatStep) {
  Loop loop(true, 1000);
  loop.hold.pause();
  loop.hold.flyUntil(321);
  while (!loop.hold.place().held) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(321u, loop.hold.place().step);
}

TEST(Hold, ResetBeginsAgainAndAHeldRunStaysHeld) {
  Loop loop(true, 1000);
  loop.hold.pause();
  loop.hold.steps(7);
  loop.hold.subIterate();
  RunPlace place = loop.hold.reset();
  EXPECT_TRUE(place.held);
  EXPECT_EQ(0u, place.step);
  EXPECT_EQ(0u, place.iteration);
  EXPECT_EQ(2u, loop.starts);
  EXPECT_EQ(2u, loop.hold.steps(2).step);
  loop.hold.resume();
  loop.join();
  EXPECT_TRUE(loop.hold.place().ended);
}

TEST(Hold, ACheckpointLeavesAHeldRunHeld) {
  Loop loop(true, 100);
  loop.hold.pause();
  loop.hold.steps(4);
  loop.hold.subIterate();  // in the middle of step 5
  const RunPlace place = loop.hold.checkpoint();
  EXPECT_EQ("held after step 4, sub-iteration 0 of step 5", place.describe());
  EXPECT_EQ(4u, loop.kept);
  EXPECT_EQ(1u, loop.checkpoints);
  EXPECT_TRUE(loop.hold.pause().held);
  EXPECT_EQ(4 * kSubIterations + 1, loop.evaluations);
}

TEST(Hold, ACheckpointOfAFlyingRunLetsItFlyOn) {
  Loop loop(false, 4000000000u);
  while (loop.evaluations < 100) std::this_thread::yield();
  for (std::uint32_t n = 1; n <= 20; ++n) {
    const RunPlace place = loop.hold.checkpoint();
    EXPECT_FALSE(place.held);
    EXPECT_FALSE(place.ended);
    EXPECT_EQ(place.step, loop.kept);
    EXPECT_EQ(n, loop.checkpoints);
  }
  const std::uint32_t before = loop.evaluations;
  while (loop.evaluations < before + 100) std::this_thread::yield();
}

// Who asks for one sub-iteration while a checkpoint is written gets it, and no request is lost.
TEST(Hold, ASubIterationAskedForDuringACheckpointIsFlown) {
  Loop loop(true, 100);
  loop.hold.pause();
  loop.slow_disk = true;
  std::thread keeper([&] { loop.hold.checkpoint(); });
  while (loop.checkpoints == 0) std::this_thread::yield();
  std::thread person([&] { loop.hold.subIterate(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(0u, loop.evaluations);
  loop.slow_disk = false;
  keeper.join();
  person.join();
  EXPECT_EQ(1u, loop.evaluations);
  EXPECT_EQ(1u, loop.hold.place().iteration);
}

TEST(Hold, AnotherRequestOvertakesOneThatWaits) {
  Loop loop(true, 4000000000u);
  loop.hold.pause();
  RunPlace stepped;
  std::thread patient([&] { stepped = loop.hold.steps(3000000000u); });
  while (loop.evaluations < 100) std::this_thread::yield();
  const RunPlace paused = loop.hold.pause();
  patient.join();
  EXPECT_TRUE(paused.held);
  EXPECT_LT(stepped.step, 3000000000u);
}

TEST(Hold, TheEndFreesWhoWaits) {
  Loop loop(true, 4000000000u);
  loop.hold.pause();
  RunPlace stepped;
  std::thread patient([&] { stepped = loop.hold.steps(3000000000u); });
  while (loop.evaluations < 100) std::this_thread::yield();
  loop.stop = true;
  patient.join();
  EXPECT_TRUE(stepped.ended);
  EXPECT_EQ("the run is over: stopped", stepped.describe());
  EXPECT_TRUE(loop.hold.pause().ended);
  EXPECT_TRUE(loop.hold.reset().ended);
  EXPECT_TRUE(loop.hold.checkpoint().ended);
}

}  // namespace
}  // namespace monarch_flight
