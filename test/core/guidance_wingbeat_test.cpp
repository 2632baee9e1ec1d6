// A wingbeat that is led: without commands the motion itself, with them smooth and within bounds.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/coupling_fakes.h"
#include "monarch_flight/coupling/interface_values.h"
#include "monarch_flight/guidance/command_inbox.h"
#include "monarch_flight/guidance/command_remarks.h"
#include "monarch_flight/guidance/wingbeat_guidance.h"

namespace monarch_flight {
namespace {

using testing::SineFlapping;

constexpr double kFrequency = 10.0, kDt = 1e-4, kStart = 0.02;

WingbeatSettings settings() {
  WingbeatSettings s;
  for (CommandLimits& limits : s.limits) limits = {-0.25, 0.25, 10.0};
  s.time_constant = 0.025;
  s.frequency = kFrequency;
  s.dt = kDt;
  return s;
}

/// Commands by a function of the step.
class Scripted : public CommandSource {
 public:
  explicit Scripted(std::function<std::optional<WingbeatChange>(std::uint32_t)> law)
      : law_(std::move(law)) {}
  void start() override {}
  std::optional<WingbeatChange> next(const WingbeatLevel& level) override {
    return law_(level.level.step);
  }

 private:
  std::function<std::optional<WingbeatChange>(std::uint32_t)> law_;
};

/// A run of guidance alone: level by level, the body standing still.
class Led {
 public:
  explicit Led(std::unique_ptr<CommandSource> source, const WingbeatSettings& s = settings())
      : guidance(std::make_shared<SineFlapping>(), std::make_shared<SteadyWind>(), s, kStart,
                 std::move(source)) {
    level = guidance.start(kStart);
  }
  void step() {
    ++n;
    GuidanceInput input;
    input.step = n;
    input.t = kStart + n * kDt;
    input.dt = kDt;
    input.interface = level.interface();
    input.prescribed = level;
    level = guidance.next(input);
  }
  WingbeatGuidance guidance;
  PrescribedState level;
  std::uint32_t n = 0;
};

TEST(WingbeatGuidance, WithoutACommandIsTheMotionBitForBit) {
  Led led(nullptr);
  const SineFlapping motion;
  for (int i = 0; i < 3000; ++i) {
    led.step();
    const PrescribedState expected = motion.at(kStart + led.n * kDt);
    ASSERT_EQ(prescribedValues(led.level), prescribedValues(expected)) << led.n;
  }
  EXPECT_NEAR(led.guidance.report().phase, kFrequency * (kStart + 3000 * kDt), 1e-9);
}

/// Every command at once: rates and accelerations are the derivatives of the angles.
TEST(WingbeatGuidance, AnglesHaveTheDerivativesThatItSays) {
  WingbeatChange all;
  int k = 0;
  for (const CommandInfo& info : kCommandTable) all.*info.value = 0.035 * ++k - 0.135;
  Led led(std::make_unique<Scripted>([&](std::uint32_t n) -> std::optional<WingbeatChange> {
    if (n == 3) return all;
    return std::nullopt;
  }));
  std::vector<std::array<Coordinate, 5>> levels;
  for (int i = 0; i < 2000; ++i) {
    led.step();
    const auto& [right, left] = led.level.angles.wings;
    levels.push_back({right.phi, right.psi, left.phi, left.psi, led.level.angles.theta_A});
  }
  double worst_rate = 0.0, worst_acceleration = 0.0;
  for (std::size_t i = 1; i + 1 < levels.size(); ++i) {
    for (std::size_t a = 0; a < 5; ++a) {
      const Coordinate &l = levels[i - 1][a], &m = levels[i][a], &r = levels[i + 1][a];
      worst_rate = std::max(worst_rate, std::abs((r.q - l.q) / (2.0 * kDt) - m.qd));
      worst_acceleration =
          std::max(worst_acceleration, std::abs((r.qd - l.qd) / (2.0 * kDt) - m.qdd));
    }
  }
  EXPECT_LT(worst_rate, 2e-3);         // of some 60 rad/s; dt^2/6 of the third derivative
  EXPECT_LT(worst_acceleration, 0.3);  // of some 5000 rad/s^2
}

TEST(WingbeatGuidance, CommandsDoWhatTheySay) {
  WingbeatChange wanted;
  wanted.amplitude = 0.2;
  wanted.flapping_mean = 0.1;
  wanted.frequency = -0.1;
  wanted.deviation_mean = 0.05;
  wanted.rest_angle = 0.07;
  wanted.abdomen_mean = -0.06;
  wanted.abdomen_amplitude = 0.25;
  Led led(std::make_unique<Scripted>([&](std::uint32_t) { return wanted; }));
  for (int i = 0; i < 10000; ++i) led.step();  // ten flaps: the filters have settled
  double low[3] = {1e9, 1e9, 1e9}, high[3] = {-1e9, -1e9, -1e9};
  const double phase = led.guidance.report().phase;
  for (int i = 0; i < 10000; ++i) {
    led.step();
    const double q[3] = {led.level.angles.wings.right.phi.q, led.level.angles.wings.right.psi.q,
                         led.level.angles.theta_A.q};
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], q[a]);
      high[a] = std::max(high[a], q[a]);
    }
  }
  EXPECT_NEAR(0.5 * (high[0] + low[0]), 0.1 + 0.1, 1e-5);  // SineFlapping: 0.1 +- 0.9
  EXPECT_NEAR(0.5 * (high[0] - low[0]), 0.9 * 1.2, 1e-5);
  EXPECT_NEAR(0.5 * (high[1] + low[1]), 0.05, 1e-5);
  EXPECT_NEAR(0.5 * (high[1] - low[1]), 0.05, 1e-5);
  EXPECT_NEAR(0.5 * (high[2] + low[2]), 0.3 - 0.06, 1e-5);
  EXPECT_NEAR(0.5 * (high[2] - low[2]), 0.2 * 1.25, 1e-5);
  for (Side side : kSides) EXPECT_NEAR(led.level.rest_angle[side], 0.07, 1e-12);
  EXPECT_NEAR(led.guidance.report().phase - phase, 0.9 * kFrequency * 1.0, 1e-9);  // one second
}

TEST(WingbeatGuidance, DifferencesAreOnTopForTheRightWingAndLessForTheLeftOne) {
  WingbeatChange wanted;
  wanted.amplitude = 0.1;
  wanted.flapping_mean = 0.1;
  wanted.deviation_mean = 0.05;
  wanted.rest_angle = 0.07;
  wanted.differential_amplitude = 0.2;
  wanted.differential_flapping = -0.06;
  wanted.differential_deviation = 0.02;
  wanted.differential_rest_angle = 0.03;
  Led led(std::make_unique<Scripted>([&](std::uint32_t) { return wanted; }));
  for (int i = 0; i < 10000; ++i) led.step();  // ten flaps: the filters have settled
  PerWing<std::array<double, 2>> low{{1e9, 1e9}, {1e9, 1e9}}, high{{-1e9, -1e9}, {-1e9, -1e9}};
  for (int i = 0; i < 1000; ++i) {
    led.step();
    for (Side side : kSides) {
      const WingAngles& wing = led.level.angles.wings[side];
      const double q[2] = {wing.phi.q, wing.psi.q};
      for (std::size_t a = 0; a < 2; ++a) {
        low[side][a] = std::min(low[side][a], q[a]);
        high[side][a] = std::max(high[side][a], q[a]);
      }
    }
  }
  for (Side side : kSides) {
    const double sign = side == Side::kRight ? 1.0 : -1.0;
    const auto &l = low[side], &h = high[side];
    EXPECT_NEAR(0.5 * (h[0] + l[0]), 0.2 - sign * 0.06, 1e-4);  // SineFlapping: 0.1 +- 0.9
    EXPECT_NEAR(0.5 * (h[0] - l[0]), 0.9 * (1.1 + sign * 0.2), 1e-4);
    EXPECT_NEAR(0.5 * (h[1] + l[1]), 0.05 + sign * 0.02, 1e-4);
    EXPECT_NEAR(led.level.rest_angle[side], 0.07 + sign * 0.03, 1e-12);
  }
}

TEST(WingbeatGuidance, CutsWhatIsOutOfBoundsRefusesWhatIsNoNumberAndCounts) {
  WingbeatChange wide, broken;
  wide.amplitude = 3.0;
  wide.deviation_mean = -3.0;
  broken.amplitude = -0.1;
  broken.frequency = std::numeric_limits<double>::quiet_NaN();
  Led led(std::make_unique<Scripted>([&](std::uint32_t n) -> std::optional<WingbeatChange> {
    if (n == 5) return wide;
    if (n == 7 || n == 8) return broken;
    return std::nullopt;
  }));
  for (int i = 0; i < 20; ++i) led.step();
  const GuidanceReport report = led.guidance.report();
  EXPECT_EQ(report.clipped, 1u);
  EXPECT_EQ(report.refused, 2u);
  EXPECT_EQ(report.command.amplitude, 0.25);
  EXPECT_EQ(report.command.deviation_mean, -0.25);
}

TEST(WingbeatGuidance, GoesOnFromItsMemoryBitForBit) {
  const auto law = [](std::uint32_t n) -> std::optional<WingbeatChange> {
    WingbeatChange c;
    c.amplitude = 0.2 * std::sin(0.01 * n);
    c.frequency = 0.1 * std::cos(0.003 * n);
    return c;
  };
  Led whole(std::make_unique<Scripted>(law)), cut(std::make_unique<Scripted>(law));
  for (int i = 0; i < 700; ++i) whole.step();
  StateSnapshot kept;
  kept.take([&](StateVisitor& s) { whole.guidance.memory(s); });
  kept.putBack([&](StateVisitor& s) { cut.guidance.memory(s); });
  cut.n = whole.n;
  for (int i = 0; i < 700; ++i) {
    whole.step();
    cut.step();
    ASSERT_EQ(prescribedValues(whole.level), prescribedValues(cut.level));
  }
}

TEST(WingbeatGuidance, NamesEveryFaultOfItsSettings) {
  WingbeatSettings s = settings();
  s.time_constant = 0.0;
  s.frequency = 0.0;
  s.limits[0] = {-1.5, -0.1, 0.0};
  const std::vector<std::string> faults = s.problems();
  EXPECT_EQ(faults.size(), 5u);
  EXPECT_THROW(Led(nullptr, s), InputError);
}

TEST(CommandInbox, ANewCommandWaitsForTheNextFlapUnlessAtOnce) {
  auto inbox = std::make_shared<CommandInbox>();
  Led led(std::make_unique<PostedCommands>(inbox));
  for (int i = 0; i < 10; ++i) led.step();  // phase 0.21
  inbox->post({0.1}, false);
  inbox->post({0.2}, false);  // the newest counts
  for (int i = 0; i < 785; ++i) led.step();
  EXPECT_EQ(led.guidance.report().command.amplitude, 0.0) << led.guidance.report().phase;
  for (int i = 0; i < 15; ++i) led.step();
  EXPECT_EQ(led.guidance.report().command.amplitude, 0.2) << led.guidance.report().phase;
  inbox->post({-0.1}, true);
  led.step();
  EXPECT_EQ(led.guidance.report().command.amplitude, -0.1);
}

TEST(CommandInbox, ARunThatIsSetBackIsNotLedByEarlierCommands) {
  auto inbox = std::make_shared<CommandInbox>();
  Led led(std::make_unique<PostedCommands>(inbox));
  inbox->post({0.1}, false);
  for (int i = 0; i < 10; ++i) led.step();  // waits for the next flap
  inbox->post({0.2}, true);                 // waits in the box
  led.level = led.guidance.start(kStart);
  led.n = 0;
  for (int i = 0; i < 2000; ++i) led.step();
  EXPECT_EQ(led.guidance.report().command.amplitude, 0.0);
  inbox->post({0.2}, true);
  led.step();
  EXPECT_EQ(led.guidance.report().command.amplitude, 0.2);
}

TEST(CommandRemarks, TellEachCommandAndKindOnce) {
  CommandRemarks remarks(settings().limits);
  EXPECT_TRUE(remarks.on({0.25}).empty());
  WingbeatChange wide;
  wide.amplitude = 0.5;
  wide.deviation_mean = -0.75;
  const std::vector<std::string> cut = remarks.on(wide);
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_EQ(cut[0].find("command amplitude = 0.5: is cut to 0.25; must be within [-0.25"), 0u)
      << cut[0];
  EXPECT_EQ(cut[1].find("command deviation_mean = -0.75 rad: is cut to -0.25"), 0u) << cut[1];
  EXPECT_TRUE(remarks.on(wide).empty());
  wide.amplitude = std::numeric_limits<double>::quiet_NaN();
  wide.rest_angle = 2.0;  // not cut: the message is refused as a whole
  const std::vector<std::string> refused = remarks.on(wide);
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].find("command amplitude = nan: must be a finite number"), 0u) << refused[0];
  EXPECT_TRUE(remarks.on(wide).empty());
}

}  // namespace
}  // namespace monarch_flight
