// Guidance in whole runs: solvers without a motion, led flights that are killed, gone on with and
// flown again.
#include "checkpoint_fixture.h"
#include "monarch_flight/coupling/interface_values.h"
#include "monarch_flight/guidance/wingbeat_guidance.h"
#include "monarch_flight/run/kept_participant.h"

namespace monarch_flight {
namespace {

/// Leads the wingbeat by what it sees of the flight and by what it remembers.
class Meandering : public CommandSource {
 public:
  void start() override { sum_ = 0.0; }
  std::optional<WingbeatChange> next(const WingbeatLevel& level) override {
    const BodyState& body = level.level.interface.body;
    sum_ += 0.01 * body.pitch.q;
    WingbeatChange change;
    change.amplitude = 0.1 * std::sin(40.0 * level.phase) + sum_;
    change.frequency = -0.05 * std::cos(9.0 * level.phase);
    change.deviation_mean = 0.05 * body.v.z();
    change.rest_angle = 0.1 * std::sin(7.0 * level.phase);
    return change;
  }
  void memory(StateVisitor& state) override { state("sum", sum_); }

 private:
  double sum_ = 0.0;
};

/// The same, until it fails in a step.
class Failing : public Meandering {
 public:
  explicit Failing(std::uint32_t step) : step_(step) {}
  std::optional<WingbeatChange> next(const WingbeatLevel& level) override {
    const auto change = Meandering::next(level);
    if (level.level.step == step_) throw NumericalError("the leader has lost its way");
    return change;
  }

 private:
  std::uint32_t step_;
};

class GuidedRun : public Checkpointed {
 protected:
  /// Solvers of `c` and guidance led by Meandering, or by `source`.
  RunResult flyLed(
      const Case& c, const std::string& name, bool resume = false,
      std::function<void(std::uint32_t)> act = [](std::uint32_t) {},
      std::unique_ptr<CommandSource> source = std::make_unique<Meandering>()) const {
    Checkpoints checkpoints(c, out(name), resume);
    RunOutputs files(c, out(name), &checkpoints);
    Meddler meddler(std::move(act));
    const std::string folder = checkpointFolder(out(name));
    InProcessFederation solvers(c, folder);
    KeptParticipant guidance(
        "guidance",
        std::make_unique<GuidanceParticipant>(
            makeModel(c), std::make_unique<WingbeatGuidance>(c.motion, c.wind, c.guidance.wingbeat,
                                                             c.time.t_start, std::move(source))),
        folder);
    Participants all = solvers.participants();
    all[static_cast<std::size_t>(Role::kGuidance)] = &guidance;
    FlyUntil control(stop_);
    return runCase(c, 1, all, {&files, &meddler}, control, &checkpoints);
  }
};

TEST_F(GuidedRun, SolversWithoutAnyMotionAnswerTheSame) {
  const Case c = climb();
  ASSERT_TRUE(fly(c, "whole").complete);
  Case without = c;
  without.motion = nullptr;
  RunOutputs files(c, out("without"));
  std::array<std::unique_ptr<Participant>, kRoles> owned;
  Participants all{};
  for (Role role : rolesOf(c)) {
    const auto i = static_cast<std::size_t>(role);
    owned[i] = makeParticipant(role, role == Role::kGuidance ? c : without, out("none"));
    all[i] = owned[i].get();
  }
  FlyUntil control(stop_);
  ASSERT_TRUE(runCase(c, 1, all, {&files}, control).complete);
  EXPECT_EQ(summary("whole")["state_sha256"], summary("without")["state_sha256"]);
}

TEST_F(GuidedRun, AWingbeatThatNobodyLeadsIsTheMotion) {
  ASSERT_TRUE(fly(climb(), "motion").complete);
  ASSERT_TRUE(fly(climb({{"guidance", "commands"}}), "nobody").complete);
  EXPECT_EQ(summary("motion")["state_sha256"], summary("nobody")["state_sha256"]);
}

TEST_F(GuidedRun, AKilledLedFlightGoesOnBitForBit) {
  const Case c = climb({{"guidance", "commands"}});
  ASSERT_TRUE(flyLed(c, "whole").complete);
  const pid_t child = fork();
  if (child == 0) {
    flyLed(c, "cut", false, [](std::uint32_t n) {
      if (n == 37) raise(SIGKILL);
    });
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(flyLed(c, "cut", true).complete);
  expectSameFlight("whole", "cut");
}

TEST_F(GuidedRun, AFailingGuidanceLeavesACheckpointToGoOnFrom) {
  const Case c = climb({{"guidance", "commands"}});
  ASSERT_TRUE(flyLed(c, "whole").complete);
  const RunResult failed = flyLed(
      c, "cut", false, [](std::uint32_t) {}, std::make_unique<Failing>(37));
  EXPECT_FALSE(failed.complete);
  expectHas(failed.failure, "step 37");
  expectHas(failed.failure, "the leader has lost its way");
  EXPECT_TRUE(fs::exists(part("cut", "36", "manifest.json")));
  ASSERT_TRUE(flyLed(c, "cut", true).complete);
  EXPECT_EQ(summary("cut")["resumed"][0]["step"], 36);
  expectSameFlight("whole", "cut");
}

TEST_F(GuidedRun, ALedFlightIsFlownAgainFromItsTable) {
  ASSERT_TRUE(flyLed(climb({{"guidance", "commands"}}), "led").complete);
  const Case replay =
      climb({{"guidance", "replay"}, {"guidance_file", out("led") + "/flight.csv"}});
  ASSERT_TRUE(fly(replay, "again").complete);
  EXPECT_EQ(summary("led")["state_sha256"], summary("again")["state_sha256"]);
  EXPECT_EQ(read("led", "flight.csv"), read("again", "flight.csv"));
  // The resolved case holds the table, and flies again by itself.
  const Case stored = loadCase(out("again") + "/case.yaml", {}, CONFIG_DIR);
  EXPECT_EQ(stored.sha256, replay.sha256);
  ASSERT_TRUE(fly(stored, "stored").complete);
  EXPECT_EQ(summary("led")["state_sha256"], summary("stored")["state_sha256"]);
}

TEST_F(GuidedRun, AReplayThatDoesNotFitIsRefused) {
  ASSERT_TRUE(fly(climb(), "short").complete);
  const std::string file = out("short") + "/flight.csv";
  expectHas(faults("climb_printed", {{"fluid", "quasi_steady"},
                                     {"flaps", "1"},
                                     {"steps_per_flap", "100"},
                                     {"guidance", "replay"},
                                     {"guidance_file", file}}),
            "has 51 rows: must have one a level, 101");
  expectHas(faults("climb_printed", {{"fluid", "quasi_steady"},
                                     {"flaps", "0.2"},
                                     {"steps_per_flap", "200"},
                                     {"guidance", "replay"},
                                     {"guidance_file", file}}),
            "column t = ");
  expectHas(faults("climb_printed", {{"guidance", "replay"}}), "guidance/rows is missing");
  expectHas(faults("climb_printed", {{"guidance", "controller"}}),
            "guidance/controller is missing: this case has no controller");
  expectHas(faults("climb_printed", {{"guidance_file", file}}), "only guidance:=replay reads");
  expectHas(faults("climb_printed", {{"guidance", "wizard"}}),
            "guidance/type = 'wizard': must be one of motion, commands");
}

TEST_F(GuidedRun, LimitsOfCommandsAreChecked) {
  const std::string path = write("case.yaml", R"(
name: limits
insect: {preset: monarch_paper}
fluid: {solver: quasi_steady}
motion: {type: fourier, series: monarch, frequency: 10.2, body: {position: [0, 0, 0], velocity: [1, 0, 0]}}
guidance:
  type: commands
  time_constant: 0
  limits: {amplitude: [0.1, 0.2], frequency: [-2, 0.1], deviation_mean: [0.1]}
  rates: {amplitude: -1}
free: {x: true, z: true, pitch: true, wing_pitch: true}
time: {steps_per_flap: 100, flaps: 1}
)");
  const std::string text = faults(path);
  for (const char* part :
       {"guidance/time_constant = 0 flaps: must be > 0", "guidance/rates/amplitude = -1",
        "guidance/limits/deviation_mean has 1 values: must be 2"})
    expectHas(text, part);
}

}  // namespace
}  // namespace monarch_flight
