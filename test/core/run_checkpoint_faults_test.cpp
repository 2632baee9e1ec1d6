// Checkpoints that are damaged, foreign, or cannot be written: refused by name, and the older one
// stays.
#include "checkpoint_fixture.h"

namespace monarch_flight {
namespace {

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

TEST_F(Checkpointed, AChangedCaseIsRefusedWithItsKey) {
  flyAndKill(climb(), "cut", 27);
  const std::string why = problemOfResuming(climb({{"steps_per_flap", "200"}}), "cut");
  expectHas(why, "step_0000000020: is of another case: time/steps_per_flap: 100 -> 200");
  expectHas(why, "step_0000000010: is of another case");
  expectHas(why.substr(0, why.find('\n')), "is of another case");  // the reason comes first
  expectHas(why, "resume = " + out("cut") + ": so none of its checkpoints can be used");
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
  EXPECT_EQ(two.command(), "monarch fly resume:=" + out("cut") + " ranks:=2");
  setenv("MONARCH_GO_ON", "scripts/fly resume:=here fluid_node:=mine", 1);
  EXPECT_EQ(two.command(), "scripts/fly resume:=here fluid_node:=mine");
  unsetenv("MONARCH_GO_ON");
}

TEST_F(Checkpointed, TheCommandToGoOnIsQuotedForTheShell) {
  flyAndKill(climb(), "it's cut", 27);
  const Checkpoints again(climb(), out("it's cut"), true, 1);
  const std::string path = out("it's cut");
  const std::size_t quote = path.find('\'');
  EXPECT_EQ(again.command(), "monarch fly resume:='" + path.substr(0, quote) + "'\\''" +
                                 path.substr(quote + 1) + "'");
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

TEST_F(Checkpointed, ADiskThatRefusesEndsTheRunAndTheLastCheckpointStays) {
  ASSERT_TRUE(fly(climb(), "whole").complete);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  const RunResult result = fly(climb(), "cut", false, [&](std::uint32_t n) {
    const rlimit tight{39000,
                       before.rlim_max};  // more than the tables, less than the coordinator's part
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

/// Answers to CHECKPOINT as if it had written its part, as a node on another disk does.
class Elsewhere : public Participant {
 public:
  explicit Elsewhere(Participant& solver) : solver_(solver) {}
  Reply exchange(const Request& request) override {
    if (request.key.phase != Phase::kCheckpoint) return solver_.exchange(request);
    Reply reply;
    reply.key = request.key;
    reply.interface = request.interface;
    return reply;
  }

 private:
  Participant& solver_;
};

TEST_F(Checkpointed, ACheckpointWithoutAPartIsNone) {
  const Case c = climb();
  Checkpoints checkpoints(c, out("cut"), false);
  RunOutputs files(c, out("cut"), &checkpoints);
  InProcessFederation solvers(c, checkpointFolder(out("cut")));
  Participants all = solvers.participants();
  Elsewhere wing(*all[static_cast<std::size_t>(Role::kWing)]);
  all[static_cast<std::size_t>(Role::kWing)] = &wing;
  FlyUntil control(stop_);
  const RunResult result = runCase(c, 1, all, {&files}, control, &checkpoints);
  EXPECT_FALSE(result.complete);
  expectHas(result.failure, "step_0000000010.active lacks the part of wing");
  EXPECT_FALSE(fs::exists(part("cut", "10", "")));
}

}  // namespace
}  // namespace monarch_flight
