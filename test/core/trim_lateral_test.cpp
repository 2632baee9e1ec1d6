// Flight out of the plane of symmetry: trims and modes in space, a heading held and turned to,
// wings that differ.
#include <cmath>
#include <sstream>

#include "control_fixture.h"
#include "monarch_flight/trim/control_design.h"
#include "monarch_flight/trim/controlled_flight.h"
#include "monarch_flight/trim/trim.h"
#include "trim/case_edit.h"

namespace monarch_flight {
namespace {

constexpr double kDegree = M_PI / 180.0;

Case inSpace() {
  return loadCase("climb_trimmed", {{"steps_per_flap", "200"}, {"wings", "independent"}},
                  CONFIG_DIR);
}

TEST(LateralTrim, ModesAreThoseOfTheFlightAndApartFromTheOthers) {
  const Case c = inSpace();
  ASSERT_TRUE(c.free[kY] && c.free[kRoll] && c.free[kYaw] && c.free[kThetaL]);
  TrimOptions options;
  std::ostringstream log;
  const TrimResult r = trim(c, CONFIG_DIR, options, log);
  ASSERT_TRUE(r.newton.converged) << log.str();
  ASSERT_EQ(r.floquet.size(), std::size_t(kFlapStates));
  EXPECT_LT(std::abs(r.flaps[0].turn), 1e-12);
  const FlapMap map(c, CONFIG_DIR, {}, 0);
  int lateral = 0;
  for (const FloquetMode& mode : r.floquet) {
    const double aside = mode.mode.segment<4>(6).norm(), in_plane = mode.mode.head<4>().norm();
    EXPECT_LT(std::min(aside, in_plane), 1e-6);
    const double alike = aside < in_plane ? 1.0 : -1.0;  // what the wings do
    EXPECT_LT((mode.mode.segment<2>(4) - alike * mode.mode.tail<2>()).norm(), 1e-6);
    if (aside < in_plane || mode.multiplier.imag() != 0.0) continue;
    ++lateral;
    if (std::abs(mode.multiplier) < 0.05) continue;  // nothing is left of it
    constexpr double kSmall = 0.02;
    const FlapState change = kSmall * mode.mode.real().cwiseProduct(trimScales());
    TrimPoint more = r.point, less = r.point;
    more.state += change;
    less.state -= change;
    const FlapState grown =
        0.5 *
        (map.fly(more, 1).flaps[0].end - map.fly(less, 1).flaps[0].end).cwiseQuotient(trimScales());
    const FlapState expected = kSmall * (mode.multiplier * mode.mode).real();
    EXPECT_LT((grown - expected).norm(), 0.05 * expected.norm()) << mode.multiplier;
  }
  EXPECT_GE(lateral, 4);
}

TEST(LateralTrim, AWakeHasNoRunInForIt) {
  const Case c =
      loadCase("climb_trimmed", {{"wings", "independent"}, {"fluid", "navier_stokes"}}, CONFIG_DIR);
  for (int run_in : {0, 1}) {
    try {
      FlapMap(c, CONFIG_DIR, {}, run_in);
      FAIL() << run_in;
    } catch (const InputError& e) {
      expectHas(e.what(), "fluid: must be quasi_steady for independent wings");
    }
  }
}

/// One design for all.
struct Designed {
  Designed() : c(inSpace()) {
    options.limits = ControlOptions::usualLimits(CONFIG_DIR);
    const SetPoint own = ownSetPoint(c);
    options.speeds = {own.speed};
    options.climbs = {own.climb};
    design = designController(c, options, log);
    wingbeat = wingbeatSettings(c, options);
  }
  static const Designed& get() {
    static const Designed one;
    return one;
  }
  Case c;
  ControlOptions options;
  ControlDesign design;
  WingbeatSettings wingbeat;
  std::ostringstream log;
};

double headingOf(const ControlledFlight& flight) {
  double heading = 0.0;
  for (const ControlledFlap& flap : flight.flaps) heading += flap.turn;
  return heading;
}

TEST(LateralControl, BringsASidewaysStartBack) {
  const Designed& d = Designed::get();
  ASSERT_TRUE(d.design.lateral);
  EXPECT_LT(std::abs(d.design.lateral->closed_loop.front()), 0.95);
  ControlledStart start;
  start.flaps = 20;
  start.change.tail<6>() << 0.2, 0.15, 1.0, -2.0, 0.1, 2.0;
  const ControlledFlight held = flyControlled(d.c, d.wingbeat, d.design.settings, start);
  ASSERT_TRUE(held.complete) << held.failure;
  EXPECT_FALSE(held.lost);
  EXPECT_NEAR(headingOf(held), 0.0, kDegree);
  const ControlledFlap& last = held.flaps.back();
  EXPECT_LT(std::max(last.roll_high, -last.roll_low), kDegree);
  EXPECT_LT(std::abs(last.side_velocity), 0.01);
  EXPECT_NEAR(last.speed, d.design.trim.speed, 0.01);
  start.uncontrolled = true;
  const ControlledFlight alone = flyControlled(d.c, d.wingbeat, d.design.settings, start);
  EXPECT_GT(std::abs(headingOf(alone)), 20.0 * kDegree);
}

TEST(LateralControl, TurnsToAHeadingWithoutSideSlipAndTheOtherWayInTheMirror) {
  const Designed& d = Designed::get();
  ControlledFlight flown[2];
  for (int i = 0; i < 2; ++i) {
    ControllerSettings law = d.design.settings;
    SetPoint to = law.set_points.front();
    to.flap = 1.0;
    to.heading = (i == 0 ? 1.0 : -1.0) * 45.0 * kDegree;
    law.set_points.push_back(to);
    ControlledStart start;
    start.flaps = 20;
    flown[i] = flyControlled(d.c, d.wingbeat, law, start);
    ASSERT_TRUE(flown[i].complete) << flown[i].failure;
    EXPECT_NEAR(headingOf(flown[i]), *to.heading, kDegree);
  }
  ASSERT_EQ(flown[0].flaps.size(), flown[1].flaps.size());
  for (std::size_t k = 0; k < flown[0].flaps.size(); ++k) {
    const ControlledFlap &right = flown[0].flaps[k], &left = flown[1].flaps[k];
    EXPECT_EQ(right.speed, left.speed);
    EXPECT_EQ(right.climb, left.climb);
    EXPECT_NEAR(right.turn, -left.turn, 1e-14);  // of a remainder
    EXPECT_EQ(right.roll_high, -left.roll_low);
    EXPECT_LT(std::abs(right.side_velocity), 0.05);
    EXPECT_NEAR(right.speed, d.design.trim.speed, 0.1);
  }
}

TEST(LateralControl, AWingThatHasLostAPartIsTrimmedStraightAndHeld) {
  const Designed& whole = Designed::get();
  CaseEdit edit(whole.c.resolved_yaml);
  edit.open({"insect", "left_wing"});
  edit.set({"insect", "left_wing", "tip_lost"}, 0.03);
  const Case c = caseFromText(edit.text(), "cut", {}, CONFIG_DIR);
  ControlOptions options = whole.options;
  options.guess = std::make_shared<ControlTrim>(whole.design.trim);
  std::ostringstream log;
  const ControlDesign design = designController(c, options, log);
  EXPECT_FALSE(design.trim.symmetric);
  EXPECT_GT(design.settings.lateral->commands.norm(), 0.01);
  ControlledStart start;
  start.flaps = 15;
  const ControlledFlight held =
      flyControlled(c, wingbeatSettings(c, options), design.settings, start);
  ASSERT_TRUE(held.complete) << held.failure;
  EXPECT_FALSE(held.lost);
  EXPECT_NEAR(headingOf(held), 0.0, 2.0 * kDegree);
  EXPECT_NEAR(held.flaps.back().speed, design.trim.speed, 0.01);
  // Without control its own trim is commanded.
  start.uncontrolled = true;
  start.flaps = 2;
  const ControlledFlight trimmed =
      flyControlled(c, wingbeatSettings(c, options), design.settings, start);
  for (std::size_t i = 0; i < design.settings.lateral->gains.inputs.size(); ++i) {
    const auto value = kCommandTable[design.settings.lateral->gains.inputs[i]].value;
    EXPECT_EQ(trimmed.flaps[0].command_low.*value,
              design.settings.lateral->commands(static_cast<Eigen::Index>(i)));
  }
  start.flaps = 15;
  // The whole insect's commands alone: it turns away.
  start.uncontrolled = true;
  const ControlledFlight alone = flyControlled(c, whole.wingbeat, whole.design.settings, start);
  EXPECT_GT(std::abs(headingOf(alone)), 45.0 * kDegree);
}

class LateralCase : public CaseTest {};

TEST_F(LateralCase, SectionIsReadAsItWasDesigned) {
  const Designed& d = Designed::get();
  const std::string text = withGuidance(d.c, guidanceSection(d.c, d.design));
  const Case read = caseFromText(text, "controlled", {}, CONFIG_DIR);
  ASSERT_TRUE(read.guidance.controller && read.guidance.controller->lateral);
  const LateralSettings &a = *read.guidance.controller->lateral, &b = *d.design.settings.lateral;
  EXPECT_EQ(a.gains.inputs, b.gains.inputs);
  EXPECT_LT((a.gains.state - b.gains.state).norm(), 1e-7 * b.gains.state.norm());
  EXPECT_LT((a.turn_states - b.turn_states).norm(), 1e-7 * b.turn_states.norm());
  EXPECT_LT((a.turn_commands - b.turn_commands).norm(), 1e-7 * b.turn_commands.norm());
  EXPECT_NEAR(a.turn, b.turn, 1e-8);
  EXPECT_EQ(caseFromText(read.resolved_yaml, "again", {}, CONFIG_DIR).sha256, read.sha256);
  expectHas(refusal(text, "wings: independent", "wings: mirrored"), "wings: independent");
  expectHas(refusal(text, "inputs: differential_deviation,", "inputs: deviation_mean,"),
            "'deviation_mean': must be commands of differential_amplitude");
  expectHas(refusal(text, "      flaps: [0]", "      headings_deg: [0, 1]\n      flaps: [0]"),
            "headings_deg has 2 values");
  expectHas(refusal(text, "roll: true", "roll: false"), "needs wings: independent, and free/y");
  std::string plane = text.substr(0, text.find("    lateral:"));
  plane.replace(plane.find("      flaps: [0]"), 16, "      headings_deg: [5]\n      flaps: [0]");
  EXPECT_THROW(caseFromText(plane, "changed", {}, CONFIG_DIR), InputError);
}

}  // namespace
}  // namespace monarch_flight
