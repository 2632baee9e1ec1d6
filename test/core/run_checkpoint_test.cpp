// Checkpoints: what is kept comes back bit for bit, and what is damaged is refused by name.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>

#include "case_fixture.h"
#include "monarch_flight/run/checkpoints.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/run_outputs.h"

namespace monarch_flight {
namespace {

// Does something behind every step that has been written.
class Meddler : public StepSink {
 public:
  explicit Meddler(std::function<void(std::uint32_t)> act) : act_(std::move(act)) {}
  void onStep(const CommittedStep& step) override { act_(step.step); }
  void onReset() override {}
  void onEnd(const std::string&) override {}

 private:
  std::function<void(std::uint32_t)> act_;
};

// Asks for a checkpoint before the sub-iteration `iteration` of the steps behind `first`.
class Careful : public RunControl {
 public:
  Careful(std::uint32_t first, std::uint32_t iteration) : first_(first), iteration_(iteration) {}
  Order next(std::uint32_t step, std::uint32_t iteration) override {
    if (step <= first_ || iteration != iteration_ || step == asked_) return Order::kGoOn;
    asked_ = step;
    ++orders;
    if (before) before();
    return Order::kCheckpoint;
  }
  int orders = 0;
  std::function<void()> before;

 private:
  std::uint32_t first_, iteration_, asked_ = 0;
};

class Checkpointed : public CaseTest {
 protected:
  static Case climb(CaseOverrides more = {}) {
    CaseOverrides overrides{{"fluid", "quasi_steady"},
                            {"flaps", "0.5"},
                            {"steps_per_flap", "100"},
                            {"checkpoint_every", "10"}};
    for (const auto& [key, value] : more) overrides[key] = value;
    return loadCase("climb", overrides, CONFIG_DIR);
  }
  /// A climb in Navier-Stokes air on a grid of a few thousand cells.
  static Case viscous() {
    Case c = loadCase("climb",
                      {{"fluid", "navier_stokes"},
                       {"flaps", "0.1"},
                       {"steps_per_flap", "300"},
                       {"checkpoint_every", "8"}},
                      CONFIG_DIR);
    c.grid.level = "custom";
    c.grid.cells_per_chord = 6;
    c.grid.first_cell = 0.08;
    c.grid.growth_plane = c.grid.growth_normal = 1.3;
    c.grid.far_field = 3;
    c.output.vortices_every = 0;
    return c;
  }
  std::string out(const std::string& name) const { return (folder_ / name).string(); }

  RunResult fly(const Case& c, const std::string& name, bool resume = false,
                std::function<void(std::uint32_t)> act = nullptr) const {
    Checkpoints checkpoints(c, out(name), resume, ranks_);
    RunOutputs files(c, out(name), &checkpoints);
    Meddler meddler(act ? std::move(act) : [](std::uint32_t) {});
    InProcessFederation federation(c, checkpointFolder(out(name)));
    return federation.run(1, {&files, &meddler}, stop_, &checkpoints);
  }
  RunResult flyLed(
      const Case& c, const std::string& name, RunControl& control,
      std::function<void(std::uint32_t)> act = [](std::uint32_t) {}) const {
    Checkpoints checkpoints(c, out(name), false);
    RunOutputs files(c, out(name), &checkpoints);
    Meddler meddler(std::move(act));
    InProcessFederation solvers(c, checkpointFolder(out(name)));
    return runCase(c, 1, solvers.participant(Role::kFluid), solvers.participant(Role::kFlight),
                   solvers.participant(Role::kWing), {&files, &meddler}, control, &checkpoints);
  }
  /// Flies in a process of its own, which is killed behind a step as by a power cut.
  void flyAndKill(const Case& c, const std::string& name, std::uint32_t step,
                  bool resume = false) const {
    const pid_t child = fork();
    if (child == 0) {
      fly(c, name, resume, [step](std::uint32_t n) {
        if (n == step) raise(SIGKILL);
      });
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  }
  std::string read(const std::string& name, const std::string& file) const {
    std::ifstream stream(folder_ / name / file, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(read(name, "summary.json"));
  }
  void expectSameFlight(const std::string& a, const std::string& b) const {
    EXPECT_EQ(summary(a)["state_sha256"], summary(b)["state_sha256"]);
    EXPECT_EQ(read(a, "flight.csv"), read(b, "flight.csv"));
    for (const char* key : {"steps", "sub_iterations", "fluid_evaluations", "added_mass_ratio",
                            "air_work_J", "climb_angle_deg", "theta_B_deg", "theta_R_deg"})
      EXPECT_EQ(summary(a)[key], summary(b)[key]) << key;
  }
  std::string problemOfResuming(const Case& c, const std::string& name) const {
    try {
      Checkpoints checkpoints(c, out(name), true);
      return "";
    } catch (const InputError& e) {
      return e.what();
    }
  }
  fs::path part(const std::string& name, const std::string& step, const std::string& file) const {
    return folder_ / name / "checkpoints" / ("step_00000000" + step) / file;
  }
  static void flipBit(const fs::path& file, std::uintmax_t at) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(at));
    const int byte = stream.get();
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(static_cast<char>(byte ^ 4));
  }

  StopFlag stop_{false};
  int ranks_ = 1;  // of the flow, as the run says
};

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

// A solver that cannot write its part must not look like a step that does not converge.
TEST_F(Checkpointed, ACheckpointOnDemandThatFailsEndsTheRunAndTheOlderOneStays) {
  ASSERT_TRUE(fly(climb(), "whole").complete);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  Careful control(25, 1);
  control.before = [&] {
    const rlimit tight{1000, before.rlim_max};  // less than the fluid's part
    setrlimit(RLIMIT_FSIZE, &tight);
  };
  const RunResult result = flyLed(climb(), "cut", control);
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);
  expectHas(result.failure, "fluid.h5.active cannot be written (File too large)");
  EXPECT_EQ(control.orders, 1);
  ASSERT_TRUE(fly(climb(), "cut", true).complete);
  EXPECT_EQ(summary("cut")["resumed"][0]["step"], 20);
  expectSameFlight("whole", "cut");
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

TEST_F(Checkpointed, AChangedCaseIsRefusedWithItsKey) {
  flyAndKill(climb(), "cut", 27);
  const std::string why = problemOfResuming(climb({{"steps_per_flap", "200"}}), "cut");
  expectHas(why, "step_0000000020: is of another case: time/steps_per_flap: 100 -> 200");
  expectHas(why, "step_0000000010: is of another case");
  expectHas(problemOfResuming(climb(), "nowhere"), "holds no checkpoint to go on from");
}

TEST_F(Checkpointed, DamagedFilesAreRefusedByNameAndTheOlderOneIsTaken) {
  ASSERT_TRUE(fly(climb(), "whole").complete);
  const std::vector<std::pair<std::string, std::function<void(const fs::path&)>>> damages = {
      {" bytes instead of ", [](const fs::path& p) { fs::resize_file(p, fs::file_size(p) / 2); }},
      {" has changed since it was written",
       [](const fs::path& p) { flipBit(p, fs::file_size(p) / 2); }},
      {" cannot be read", [](const fs::path& p) { fs::remove(p); }}};
  int n = 0;
  for (const char* file : {"fluid.h5", "flight.h5", "wing.h5", "coordinator.h5"}) {
    for (const auto& [words, damage] : damages) {
      const std::string name = "cut" + std::to_string(++n);
      flyAndKill(climb(), name, 27);
      damage(part(name, "20", file));
      ASSERT_TRUE(fly(climb(), name, true).complete) << file << words;
      expectSameFlight("whole", name);
      const nlohmann::json resumed = summary(name)["resumed"][0];
      EXPECT_EQ(resumed["step"], 10);
      ASSERT_EQ(resumed["refused"].size(), 1u);
      expectHas(resumed["refused"][0], "step_0000000020/" + std::string(file));
      expectHas(resumed["refused"][0], words);
    }
  }
}

TEST_F(Checkpointed, EveryByteOfTheManifestCounts) {
  flyAndKill(climb(), "cut", 27);
  const fs::path manifest = part("cut", "20", "manifest.json");
  const std::string good = read("cut", "checkpoints/step_0000000020/manifest.json");
  ASSERT_GT(good.size(), 500u);
  for (std::size_t at = 0; at < good.size(); at += 5) {
    flipBit(manifest, at);
    EXPECT_EQ(Checkpoints(climb(), out("cut"), true).resumption()->step, 10u) << at;
    flipBit(manifest, at);
  }
  fs::resize_file(manifest, good.size() / 2);
  EXPECT_EQ(Checkpoints(climb(), out("cut"), true).resumption()->step, 10u);
}

TEST_F(Checkpointed, ForeignCheckpointsAreRefused) {
  flyAndKill(climb(), "cut", 27);
  flyAndKill(climb({{"steps_per_flap", "120"}}), "other", 27);
  const fs::path mine = folder_ / "cut" / "checkpoints", theirs = folder_ / "other" / "checkpoints";
  fs::remove_all(mine / "step_0000000020");
  fs::copy(theirs / "step_0000000020", mine / "step_0000000020");
  Checkpoints checkpoints(climb(), out("cut"), true);
  EXPECT_EQ(checkpoints.resumption()->step, 10u);
  expectHas(checkpoints.resumption()->refused.at(0),
            "is of another case: time/steps_per_flap: 120 -> 100");
  // A part of another checkpoint, and a whole checkpoint under another number.
  fs::copy(theirs / "step_0000000010/fluid.h5", mine / "step_0000000010/fluid.h5",
           fs::copy_options::overwrite_existing);
  fs::copy(theirs / "step_0000000010", mine / "step_0000000015");
  const std::string why = problemOfResuming(climb(), "cut");
  expectHas(why, "step_0000000015 is a checkpoint of step 10");
  expectHas(why, "step_0000000010/fluid.h5 has changed");
}

TEST_F(Checkpointed, AnotherNumberOfProcessesIsRefusedBeforeAnythingIsTouched) {
  ranks_ = 2;
  flyAndKill(climb(), "cut", 27);
  const std::string table = read("cut", "flight.csv.active");
  expectHas(problemOfResuming(climb(), "cut"),
            "was made with the flow on 2 process(es), not on 1; give ranks:=2");
  EXPECT_EQ(table, read("cut", "flight.csv.active"));
  EXPECT_TRUE(fs::exists(part("cut", "20", "manifest.json")));
  const Checkpoints two(climb(), out("cut"), true, 2);
  EXPECT_EQ(two.command(), "scripts/fly resume:=" + out("cut") + " ranks:=2");
}

TEST_F(Checkpointed, ATableThatHasChangedIsNoticed) {
  flyAndKill(climb(), "cut", 27);
  flipBit(folder_ / "cut" / "flight.csv.active", 2000);
  expectHas(problemOfResuming(climb(), "cut"),
            "flight.csv.active does not begin with the bytes it had then");
  fs::resize_file(folder_ / "cut" / "flight.csv.active", 100);
  expectHas(problemOfResuming(climb(), "cut"), "has fewer than the ");
}

TEST_F(Checkpointed, ARunningFlightIsNotResumed) {
  const Case c = climb();
  std::string why;
  fly(c, "out", false, [&](std::uint32_t n) {
    if (n != 30) return;
    try {
      fly(c, "out", true);
    } catch (const InputError& e) {
      why = e.what();
    }
  });
  expectHas(why, "another run writes into this folder");
}

TEST_F(Checkpointed, OnlyTheLastTwoAreKeptAndHalfOnesAreNone) {
  ASSERT_TRUE(fly(climb(), "whole").complete);
  const CheckpointFiles files(checkpointFolder(out("whole")));
  EXPECT_EQ(files.steps(), (std::vector<std::uint32_t>{50, 40}));
  fs::rename(files.path(50), files.path(50) + ".active");
  EXPECT_EQ(files.steps(), (std::vector<std::uint32_t>{40}));
  EXPECT_THROW(files.verify(50), CheckpointError);
  EXPECT_EQ(files.verify(40).case_name, "climb");
  ASSERT_TRUE(fly(climb({{"checkpoint_every", "0"}}), "none").complete);
  EXPECT_FALSE(fs::exists(folder_ / "none" / "checkpoints"));
}

TEST_F(Checkpointed, ADiskThatRefusesEndsTheRunAndTheLastCheckpointStays) {
  ASSERT_TRUE(fly(climb(), "whole").complete);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  const RunResult result = fly(climb(), "cut", false, [&](std::uint32_t n) {
    const rlimit tight{24000, before.rlim_max};  // less than the coordinator's part
    if (n == 25) setrlimit(RLIMIT_FSIZE, &tight);
  });
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);
  expectHas(result.failure, "coordinator.h5.active cannot be written (File too large)");
  EXPECT_FALSE(fs::exists(part("cut", "30", "")));
  ASSERT_TRUE(fly(climb(), "cut", true).complete);
  EXPECT_EQ(summary("cut")["resumed"][0]["step"], 20);
  expectSameFlight("whole", "cut");
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
    start.interface = model.prescribed(start.t);
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
        request.interface = model.prescribed(request.t);
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
