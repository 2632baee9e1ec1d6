// The estimate of what a run writes, against what runs wrote: enough, and less than twice as much.
#include "checkpoint_fixture.h"

namespace monarch_flight {
namespace {

class OutputSize : public Checkpointed {
 protected:
  std::uint64_t written(const std::string& name) const {
    std::uint64_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name))
      if (entry.is_regular_file()) bytes += entry.file_size();
    return bytes;
  }
  /// Without a bag, which the core does not write.
  void expectEstimated(Case c, const std::string& name) const {
    c.output.record = false;
    const auto estimate = static_cast<double>(estimatedOutputBytes(c));
    ASSERT_TRUE(fly(c, name).complete) << name;
    const double ratio = estimate / static_cast<double>(written(name));
    EXPECT_GE(ratio, 1.0) << name;
    EXPECT_LE(ratio, 2.0) << name;
  }
};

Case quick(const std::string& name, const CaseOverrides& more = {}) {
  CaseOverrides overrides{{"fluid", "quasi_steady"}, {"flaps", "1.6"}};
  for (const auto& [key, value] : more) overrides[key] = value;
  return loadCase(name, overrides, CONFIG_DIR);
}

TEST_F(OutputSize, IsEstimatedWithinAFactorOfTwo) {
  expectEstimated(quick("climb_printed"), "motion");
  expectEstimated(quick("climb_printed", {{"flaps", "0.1"}}), "short");
  expectEstimated(quick("climb_printed", {{"wings", "independent"}}), "independent");
  expectEstimated(quick("climb_controlled"), "controlled");
  expectEstimated(quick("climb_turning"), "turning");
  expectEstimated(quick("climb_turning", {{"checkpoint_every", "0"}}), "bare");
  expectEstimated(quick("tethered_fwuav"), "tethered");
  expectEstimated(viscous(), "viscous");
}

/// Sizes of flight.bag as the nodes wrote them.
TEST_F(OutputSize, OfABagIsEstimatedWithinAFactorOfTwo) {
  const auto expectBag = [](Case c, double measured, const char* name) {
    c.output.record = true;
    const auto with = estimatedOutputBytes(c);
    c.output.record = false;
    const double ratio = static_cast<double>(with - estimatedOutputBytes(c)) / measured;
    EXPECT_GE(ratio, 1.0) << name;
    EXPECT_LE(ratio, 2.0) << name;
  };
  expectBag(quick("climb_printed", {{"flaps", "1"}}), 632945, "motion");
  expectBag(quick("climb_printed", {{"flaps", "0.1"}}), 105690, "short");
  expectBag(quick("climb_controlled", {{"flaps", "4"}, {"steps_per_flap", "500"}}), 2529362,
            "controlled");
  expectBag(quick("climb_turning", {{"flaps", "4"}}), 3380795, "turning");
  expectBag(
      loadCase("climb_printed", {{"fluid", "navier_stokes"}, {"grid", "preview"}, {"flaps", "0.6"}},
               CONFIG_DIR),
      4186848, "preview");
}

/// What is in the folder already needs no room; the bag is copied.
TEST_F(OutputSize, ARunThatGoesOnNeedsWhatIsLeft) {
  fly(climb(), "run");
  const std::uint64_t space = fs::space(folder_).available;
  EXPECT_THROW(RunDirectory(out("run"), 2 * space, true), InputError);
  fs::create_directories(folder_ / "run" / "fields");
  std::ofstream(folder_ / "run" / "fields" / "flow_1.vts") << "x";
  fs::resize_file(folder_ / "run" / "fields" / "flow_1.vts", 2 * space);  // a hole: takes no room
  EXPECT_NO_THROW(RunDirectory(out("run"), 2 * space, true));
  fs::rename(folder_ / "run" / "fields" / "flow_1.vts", folder_ / "run" / "flight.bag.active");
  EXPECT_THROW(RunDirectory(out("run"), 2 * space, true), InputError);
}

}  // namespace
}  // namespace monarch_flight
