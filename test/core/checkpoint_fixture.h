#pragma once
// Flights of the tests of checkpoints: whole, killed, stopped, led, gone on with, and compared.
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
    return loadCase("climb_printed", overrides, CONFIG_DIR);
  }
  /// A climb in Navier-Stokes air on a grid of a few thousand cells.
  static Case viscous() {
    Case c = loadCase("climb_printed",
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
    c.output.flow_every = 0;
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
    return runCase(c, 1, solvers.participants(), {&files, &meddler}, control, &checkpoints);
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
    for (const char* key :
         {"steps", "sub_iterations", "fluid_evaluations", "added_mass_ratio", "air_work_J",
          "climb_angle_deg", "theta_B_deg", "theta_R_deg", "mid_plane"})
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

}  // namespace monarch_flight
