// What summary.json says beside its figures: nothing was ever free, the body has turned over.
#include "checkpoint_fixture.h"
#include "monarch_flight/insect/start_motion.h"
#include "monarch_flight/math/angle.h"
#include "monarch_flight/run/summary.h"
#include "run_files_fixture.h"

namespace monarch_flight {
namespace {

nlohmann::json summaryOf(const Case& c, const std::function<double(std::uint32_t)>& pitch) {
  Summary summary(c);
  for (std::uint32_t n = 0; n <= c.time.steps; ++n) {
    CommittedStep s = stepAt(n);
    s.prescribed = n <= static_cast<std::uint32_t>(c.coupling.prescribed_steps);
    s.interface.body = withPitch(s.interface.body, {pitch(n), 0.0, 0.0});
    summary.add(s);
  }
  return nlohmann::json::parse(summary.json(""));
}

Case freeCase() {
  Case c = smallCase();  // ten steps a flap, 25 steps, the first ten prescribed
  c.free[kPitch] = true;
  return c;
}

TEST(SummaryRemarks, ARunWithoutAFreeStepSaysSo) {
  const auto level = [](std::uint32_t) { return 0.1; };
  Case c = freeCase();
  EXPECT_EQ(summaryOf(c, level).at("remarks").size(), 0u);
  EXPECT_EQ(summaryOf(c, level).at("free_steps"), 15);
  c.time.steps = 11;
  EXPECT_EQ(summaryOf(c, level).at("remarks").size(), 0u);
  EXPECT_EQ(summaryOf(c, level).at("free_steps"), 1);
  for (const std::uint32_t steps : {10u, 5u}) {
    c.time.steps = steps;
    const nlohmann::json j = summaryOf(c, level);
    EXPECT_EQ(j.at("free_steps"), 0);
    ASSERT_EQ(j.at("remarks").size(), 1u);
    const std::string remark = j.at("remarks").at(0);
    expectHas(remark, "nothing is ever free: all " + std::to_string(steps) + " steps");
    expectHas(remark,
              "as the first 10 of this case do (coupling/prescribed_flaps or prescribed_steps)");
  }
  c.time.steps = 25;
  c.time.remainder = 0.25;
  ASSERT_EQ(summaryOf(c, level).at("remarks").size(), 1u);
  expectHas(summaryOf(c, level).at("remarks").at(0), "the remainder of 0.25 steps is not flown");
  c.time = freeCase().time;
  c.free = {};  // as it was meant
  EXPECT_EQ(summaryOf(c, level).at("remarks").size(), 0u);
}

class SummaryMidPlane : public testing::Test {
 protected:
  SummaryMidPlane()
      : case_(loadCase("climb_trimmed", {{"flaps", "1"}, {"wings", "independent"}}, CONFIG_DIR)) {
    case_.coupling.prescribed_steps = 0;
  }
  /// Of five steps with wings straight out, flapped by these angles in those of `beyond`.
  nlohmann::json flapped(double right, double left, std::uint32_t beyond = 1) const {
    Summary summary(case_);
    for (std::uint32_t n = 0; n < 5; ++n) {
      CommittedStep s = stepAt(n);
      s.angles = {};
      s.angles.wings.right.phi.q = n < beyond ? right : 0.0;
      s.angles.wings.left.phi.q = n < beyond ? left : 0.0;
      summary.add(s);
    }
    return nlohmann::json::parse(summary.json(""));
  }
  /// Of the tip of a wing that is flapped by phi.
  double depth(double phi) const {
    const Wing& wing = case_.insect.wings.right;
    return -wing.plate.mu.y() - wing.planform.yTip() * std::cos(phi);
  }

  Case case_;
};

TEST_F(SummaryMidPlane, WingsThatStayOnTheirSideAreNoMatter) {
  ASSERT_LT(depth(80 * kDegree), 0.0);
  const nlohmann::json j = flapped(80 * kDegree, -80 * kDegree);
  EXPECT_EQ(j.at("mid_plane").at("depth_m"), 0.0);
  EXPECT_EQ(j.at("mid_plane").at("share_of_steps"), 0.0);
  EXPECT_EQ(j.at("remarks").size(), 0u);
}

TEST_F(SummaryMidPlane, TellsHowFarAWingPassesThroughIt) {
  const double over = 100 * kDegree;
  ASSERT_GT(depth(over), 0.0);
  for (const auto& [right, left] : {std::pair{over, 0.0}, {-over, 0.0}, {0.0, over}, {0.0, -over}})
    for (const std::uint32_t steps : {1u, 5u}) {
      const nlohmann::json j = flapped(right, left, steps);
      EXPECT_NEAR(j.at("mid_plane").at("depth_m"), depth(over), 1e-12);
      EXPECT_NEAR(j.at("mid_plane").at("share_of_steps"), steps / 5.0, 1e-12);
      ASSERT_EQ(j.at("remarks").size(), 1u);
      expectHas(j.at("remarks").at(0), "the wings pass through the insect's mid-plane by up to ");
      expectHas(j.at("remarks").at(0), steps == 5 ? "in 100.0 % of" : "in 20.0 % of");
    }
}

TEST(SummaryTumbled, NamesTheFirstFlapBeyondSixtyDegrees) {
  const double degree = kPi / 180.0;
  const auto beyond = [degree](std::uint32_t first, double angle) {
    return [=](std::uint32_t n) { return n == first ? angle * degree : 59.9 * degree; };
  };
  const Case c = freeCase();
  nlohmann::json j = summaryOf(c, beyond(99, 0.0));
  EXPECT_TRUE(j.at("tumbled_from_flap").is_null());
  EXPECT_TRUE(j.at("tumbled_from_step").is_null());
  // Either way over; the last step of a flap belongs to it. Once over, over.
  const std::pair<std::uint32_t, int> steps[] = {{0, 1},  {1, 1},  {10, 1},
                                                 {11, 2}, {20, 2}, {21, 3}};
  for (const auto& [step, flap] : steps) {
    j = summaryOf(c, beyond(step, step % 2 ? 60.1 : -60.1));
    EXPECT_EQ(j.at("tumbled_from_flap"), flap) << step;
    EXPECT_EQ(j.at("tumbled_from_step"), step);
  }
  Case still = c;
  still.time.period = 0.0;  // no flaps to count
  j = summaryOf(still, beyond(7, 70));
  EXPECT_TRUE(j.at("tumbled_from_flap").is_null());
  EXPECT_EQ(j.at("tumbled_from_step"), 7);
  Case led = c;
  led.free[kPitch] = false;  // a motion that turns over is what was asked for
  EXPECT_TRUE(summaryOf(led, beyond(7, 70)).at("tumbled_from_step").is_null());
}

TEST_F(RunFiles, AResetForgetsThatTheBodyHasTurnedOver) {
  Case c = freeCase();
  RunOutputs outputs(c, out());
  CommittedStep over = stepAt(3);
  over.interface.body = withPitch(over.interface.body, {2.0, 0.0, 0.0});
  outputs.onStep(stepAt(0));
  outputs.onStep(over);
  outputs.onReset();
  outputs.onStep(stepAt(0));
  outputs.onStep(stepAt(1));
  outputs.onEnd("");
  EXPECT_TRUE(nlohmann::json::parse(read("summary.json")).at("tumbled_from_step").is_null());
}

/// Behind a checkpoint at step 20 the body has turned over already.
TEST_F(Checkpointed, ThatTheBodyHasTurnedOverOutlivesAKilledRun) {
  Case c = climb();
  const auto tumble = [](const Case& base) {  // 59 deg and turning at the start
    Case over = base;
    StartValues start;
    start.pitch = StartValue{1.04, 20.0, 0.0};
    over.motion = std::make_shared<StartMotion>(base.motion, start, base.time.t_start);
    return over;
  };
  c = tumble(c);
  ASSERT_TRUE(fly(c, "whole").complete);
  const nlohmann::json step = summary("whole").at("tumbled_from_step");
  ASSERT_TRUE(step.is_number());
  ASSERT_LT(step, 20);
  flyAndKill(c, "cut", 27);
  ASSERT_TRUE(fly(c, "cut", true).complete);
  EXPECT_EQ(summary("cut").at("resumed").at(0).at("step"), 20);
  EXPECT_EQ(summary("cut").at("tumbled_from_step"), step);
  EXPECT_EQ(summary("cut").at("tumbled_from_flap"), 1);
}

}  // namespace
}  // namespace monarch_flight
