// Checkpoints: what is kept comes back bit for bit.
#include "checkpoint_fixture.h"

namespace monarch_flight {
namespace {

TEST_F(Checkpointed, AKilledFlightGoesOnBitForBit) {
  ASSERT_TRUE(fly(climb(), "whole").complete);
  flyAndKill(climb(), "cut", 27);
  flyAndKill(climb(), "cut", 44, true);  // and once more, from step 20
  EXPECT_FALSE(fs::exists(folder_ / "cut" / "summary.json"));
  ASSERT_TRUE(fly(climb(), "cut", true).complete);
  expectSameFlight("whole", "cut");
  const nlohmann::json resumed = summary("cut")["resumed"];
  ASSERT_EQ(resumed.size(), 2u);
  EXPECT_EQ(resumed[0]["step"], 20);
  EXPECT_EQ(resumed[1]["step"], 40);
  EXPECT_FALSE(summary("whole").contains("resumed"));
}

TEST_F(Checkpointed, NavierStokesGoesOnBitForBit) {
  const Case c = viscous();
  ASSERT_TRUE(fly(c, "whole").complete);
  flyAndKill(c, "cut", 21);
  ASSERT_TRUE(fly(c, "cut", true).complete);
  EXPECT_EQ(summary("cut")["resumed"][0]["step"], 16);
  expectSameFlight("whole", "cut");
}

TEST_F(Checkpointed, AStoppedFlightKeepsItsLastStep) {
  for (const char* relaxation : {"added_mass", "iqn_ils", "aitken"}) {
    Case c = climb();
    c.coupling.relaxation = relaxation == std::string("added_mass") ? Relaxation::kAddedMass
                            : relaxation == std::string("iqn_ils")  ? Relaxation::kIqnIls
                                                                    : Relaxation::kAitken;
    const std::string name = relaxation;
    ASSERT_TRUE(fly(c, "whole_" + name).complete);
    const RunResult stopped = fly(c, name, false, [this](std::uint32_t n) { stop_ = n == 33; });
    expectHas(stopped.failure, "interrupted in step 34; step 33 is the last one committed");
    stop_ = false;
    EXPECT_TRUE(fs::exists(part(name, "33", "manifest.json")));
    ASSERT_TRUE(fly(c, name, true).complete);
    EXPECT_EQ(summary(name)["resumed"][0]["step"], 33);
    expectSameFlight("whole_" + name, name);
  }
}

// In the middle of a step, with every accelerator: no trace in the flight, and it goes on from
// there.
TEST_F(Checkpointed, ACheckpointOnDemandKeepsTheLastStepAndChangesNothing) {
  for (const Relaxation relaxation :
       {Relaxation::kAddedMass, Relaxation::kIqnIls, Relaxation::kAitken}) {
    Case c = climb();
    c.coupling.relaxation = relaxation;
    const std::string name = std::to_string(static_cast<int>(relaxation));
    ASSERT_TRUE(fly(c, "whole_" + name).complete);
    for (const std::uint32_t iteration : {0u, 1u}) {
      const std::string led = name + "_" + std::to_string(iteration);
      Careful control(12, iteration);
      ASSERT_TRUE(flyLed(c, led, control).complete);
      EXPECT_GT(control.orders, 30);
      expectSameFlight("whole_" + name, led);
      const std::string cut = "cut_" + led;
      Careful again(12, iteration);
      bool stopped = false;
      const RunResult result = flyLed(c, cut, again, [&](std::uint32_t n) {
        stopped = n == 34;
        if (stopped) throw OutputError("no more of this");
      });
      ASSERT_FALSE(result.complete);
      ASSERT_TRUE(stopped);
      EXPECT_TRUE(fs::exists(part(cut, "33", "manifest.json")));
      ASSERT_TRUE(fly(c, cut, true).complete);
      EXPECT_EQ(summary(cut)["resumed"][0]["step"], 33);
      expectSameFlight("whole_" + name, cut);
    }
  }
}

// The step is solved half when it fails: what is kept is the state before it.
TEST_F(Checkpointed, AFailedStepLeavesTheOneBefore) {
  const Case c = climb();
  ASSERT_TRUE(fly(c, "whole").complete);
  Case strict = c;
  strict.coupling.max_sub_iterations = 2;
  strict.coupling.tolerance = 1e-15;  // out of reach
  const RunResult failed = fly(strict, "strict");
  expectHas(failed.failure, "step 11 ");
  EXPECT_TRUE(fs::exists(part("strict", "10", "manifest.json")));
  ASSERT_TRUE(fly(c, "strict", true).complete);
  expectSameFlight("whole", "strict");
}

TEST_F(Checkpointed, ALongerFlightIsTheSameAsOneInOnePiece) {
  ASSERT_TRUE(fly(climb({{"flaps", "0.8"}}), "long").complete);
  ASSERT_TRUE(fly(climb(), "short").complete);
  ASSERT_TRUE(fly(climb({{"flaps", "0.8"}}), "short", true).complete);
  expectSameFlight("long", "short");
  EXPECT_EQ(summary("short")["resumed"][0]["changed"], nlohmann::json({"time/flaps: 0.5 -> 0.8"}));
  expectHas(problemOfResuming(climb({{"flaps", "0.3"}}), "short"),
            "the run is to end with step 30, before this one; give more flaps:=");
}

TEST_F(Checkpointed, AnotherAcceleratorIsAllowedAndRecorded) {
  flyAndKill(climb(), "cut", 27);
  std::string yaml = read("cut", "case.yaml");
  const std::size_t at = yaml.find("relaxation: added_mass");
  ASSERT_NE(at, std::string::npos);
  const Case aitken =
      caseFromText(yaml.replace(at, 22, "relaxation: aitken"), "aitken", {}, CONFIG_DIR);
  ASSERT_TRUE(fly(aitken, "cut", true).complete);
  EXPECT_EQ(summary("cut")["resumed"][0]["changed"],
            nlohmann::json({"coupling/relaxation: added_mass -> aitken"}));
}

TEST_F(Checkpointed, OnlyTheLastTwoAreKeptAndHalfOnesAreNone) {
  ASSERT_TRUE(fly(climb(), "whole").complete);
  const CheckpointFiles files(checkpointFolder(out("whole")));
  EXPECT_EQ(files.steps(), (std::vector<std::uint32_t>{50, 40}));
  fs::rename(files.path(50), files.path(50) + ".active");
  EXPECT_EQ(files.steps(), (std::vector<std::uint32_t>{40}));
  EXPECT_THROW(files.verify(50), CheckpointError);
  EXPECT_EQ(files.verify(40).case_name, "climb_printed");
  ASSERT_TRUE(fly(climb({{"checkpoint_every", "0"}}), "none").complete);
  EXPECT_FALSE(fs::exists(folder_ / "none" / "checkpoints"));
}

// The same step a hundred times from the same state, both fluids: every bit of the answers.
TEST_F(Checkpointed, ARestoredStepIsTheSameAHundredTimes) {
  for (const bool viscous_air : {false, true}) {
    const Case c = viscous_air ? viscous() : climb();
    const std::string name = viscous_air ? "viscous" : "quasi_steady";
    ASSERT_TRUE(fly(c, name, false, [this](std::uint32_t n) { stop_ = n == 12; }).failure != "");
    stop_ = false;
    const auto fluid = makeParticipant(Role::kFluid, c, checkpointFolder(out(name)));
    const CoupledModel model = makeModel(c);
    Request start;
    start.key.run = 5;
    start.t = model.time(0);
    start.prescribed = c.motion->at(start.t);
    start.interface = start.prescribed.interface();
    ASSERT_EQ(fluid->exchange(start).error, "");
    std::vector<double> first;
    for (int i = 0; i < 100; ++i) {
      Request request = start;
      request.key.step = 12;
      request.key.phase = Phase::kRestore;
      ASSERT_EQ(fluid->exchange(request).error, "");
      std::vector<double> answers;
      for (std::uint32_t step = 13; step < 15; ++step) {
        request.key = {5, step, 0, Phase::kIterate, 0};
        request.t = model.time(step);
        request.prescribed = c.motion->at(request.t);
        request.interface = request.prescribed.interface();
        const Loads loads = fluid->exchange(request).loads;
        for (const Eigen::Vector3d& v : {loads.force_pressure, loads.force_friction,
                                         loads.moment_pressure, loads.moment_friction})
          answers.insert(answers.end(), v.data(), v.data() + 3);
        request.key.phase = Phase::kCommit;
        ASSERT_EQ(fluid->exchange(request).error, "");
      }
      if (first.empty()) first = answers;
      ASSERT_EQ(answers, first) << name << ", repetition " << i;
    }
    EXPECT_NE(first[2], 0.0);
  }
}

}  // namespace
}  // namespace monarch_flight
