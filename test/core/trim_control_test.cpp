// Design of a controller: Riccati's recursion against known solutions, the linear maps against
// whole flights, and a monarch that it keeps in the air.
#include <cmath>
#include <sstream>

#include "control_fixture.h"
#include "monarch_flight/trim/command.h"
#include "monarch_flight/trim/controlled_flight.h"
#include "monarch_flight/trim/trim.h"
#include "trim/case_edit.h"

namespace monarch_flight {
namespace {

using Eigen::MatrixXd;

TEST(PeriodicLqr, ScalarHasItsClosedForm) {
  const double a = 1.4, b = 0.5, q = 0.3, r = 2.0;
  const LinearStage stage{MatrixXd::Constant(1, 1, a), MatrixXd::Constant(1, 1, b)};
  const PeriodicLqr lqr =
      periodicLqr({stage}, MatrixXd::Constant(1, 1, q), MatrixXd::Constant(1, 1, r), 1e-14);
  ASSERT_TRUE(lqr.converged);
  // b^2 p^2 + (r - a^2 r - q b^2) p - q r = 0
  const double B = r - a * a * r - q * b * b;
  const double p = (-B + std::sqrt(B * B + 4 * b * b * q * r)) / (2 * b * b);
  EXPECT_NEAR(lqr.cost(0, 0), p, 1e-10 * p);
  EXPECT_NEAR(lqr.gains[0](0, 0), a * b * p / (r + b * b * p), 1e-10);
  const auto closed = multipliers({stage}, lqr.gains);
  EXPECT_NEAR(std::abs(closed[0]), std::abs(a - b * lqr.gains[0](0, 0)), 1e-14);
  EXPECT_LT(std::abs(closed[0]), 1.0);
}

/// Double integrator with a unit step, weight on the position only: with g = sqrt(1/r) the closed
/// loop satisfies (z^2 - 2 z + 1)(1 - 2 z + z^2) + g^2 (z + 1)^2 z / 4 = 0 (spectral
/// factorisation).
TEST(PeriodicLqr, DoubleIntegratorHasTheRootsOfItsSpectrum) {
  MatrixXd A(2, 2), B(2, 1), Q = MatrixXd::Zero(2, 2);
  A << 1, 1, 0, 1;
  B << 0.5, 1;
  Q(0, 0) = 1.0;
  const double r = 3.0;
  const std::vector<LinearStage> one{{A, B}};
  const PeriodicLqr lqr = periodicLqr(one, Q, MatrixXd::Constant(1, 1, r), 1e-14);
  ASSERT_TRUE(lqr.converged);
  for (const std::complex<double>& z : multipliers(one, lqr.gains)) {
    EXPECT_LT(std::abs(z), 1.0);
    // r + G(1/z) G(z) = 0 with G = (z + 1) / (2 (z - 1)^2), the path from input to position.
    const auto G = [](std::complex<double> s) { return 0.5 * (s + 1.0) / ((s - 1.0) * (s - 1.0)); };
    EXPECT_LT(std::abs(r + G(z) * G(1.0 / z)), 1e-8);
  }
}

TEST(PeriodicLqr, StagesOfAPeriodAreOneSystem) {
  MatrixXd A(2, 2), B(2, 1);
  A << 1, 0.3, -0.2, 1.1;
  B << 0.1, 0.7;
  const MatrixXd Q = MatrixXd::Identity(2, 2), R = MatrixXd::Constant(1, 1, 0.5);
  const LinearStage stage{A, B};
  const PeriodicLqr once = periodicLqr({stage}, Q, R, 1e-13);
  const PeriodicLqr thrice = periodicLqr({stage, stage, stage}, Q, R, 1e-13);
  for (const MatrixXd& gain : thrice.gains) EXPECT_LT((gain - once.gains[0]).norm(), 1e-9);
  EXPECT_LT((thrice.cost - once.cost).norm(), 1e-9 * once.cost.norm());
  // Truly periodic: no other gain of a stage does better, whatever the state it begins in.
  const std::vector<LinearStage> two{{A, B}, {0.8 * A, -2.0 * B}};
  const PeriodicLqr best = periodicLqr(two, Q, R, 1e-13);
  const auto cost = [&](const std::vector<MatrixXd>& gains) {
    MatrixXd total = MatrixXd::Zero(2, 2), X = MatrixXd::Identity(2, 2);
    for (std::size_t j = 0; j < 400; ++j) {
      const MatrixXd& K = gains[j % 2];
      total += X.transpose() * (Q + K.transpose() * R * K) * X;
      X = (two[j % 2].A - two[j % 2].B * K) * X;
    }
    return total.trace();
  };
  EXPECT_NEAR(cost(best.gains), best.cost.trace(), 1e-6 * best.cost.trace());
  for (double change : {-0.05, 0.05}) {
    auto other = best.gains;
    other[1](0, 0) += change;
    EXPECT_GT(cost(other), cost(best.gains));
  }
}

/// One design for all: the trimmed climb, 200 steps a flap.
struct Designed {
  Designed() {
    c = loadCase("climb_trimmed", {{"steps_per_flap", "200"}}, CONFIG_DIR);
    options.limits = ControlOptions::usualLimits(CONFIG_DIR);
    const SetPoint own = ownSetPoint(c);
    options.speeds = {own.speed};
    options.climbs = {own.climb};
    design = designController(c, options, log);
  }
  static const Designed& get() {
    static const Designed one;
    return one;
  }
  Case c;
  ControlOptions options;
  ControlDesign design;
  std::ostringstream log;
};

TEST(ControlDesign, LinearMapsComposeToTheWholeFlap) {
  const Designed& d = Designed::get();
  const int N = d.options.samples;
  const PhaseMap map(d.c, N, d.options.time_constant * d.c.time.period);
  const auto& states = d.design.settings.table.states();
  WingbeatStart wingbeat;
  for (std::size_t i = 0; i < d.options.inputs.size(); ++i) {
    const double u = d.design.settings.table.commands()(0, static_cast<Eigen::Index>(i));
    wingbeat.command.*kCommandTable[d.options.inputs[i]].value = u;
    wingbeat.filters[d.options.inputs[i]] = {u, 0.0, 0.0};
  }
  FlapState start = FlapState::Zero();
  start.head<6>() = states.row(0).transpose();
  const auto end = [&](const FlapState& from, const WingbeatStart& w) {
    const FlapState rates = map.ratesAt(0, from, w);
    const PhaseFlight flight = map.fly(0, from, w, N, &rates);
    EXPECT_TRUE(flight.complete) << flight.failure;
    return flight.states.back();
  };
  MatrixXd A = MatrixXd::Identity(14, 14);
  MatrixXd B = MatrixXd::Zero(14, 2);  // of a command held over the flap
  for (const LinearStage& stage : d.design.in_plane.stages) {
    B = (stage.A * B + stage.B).eval();
    A = (stage.A * A).eval();
  }
  using InPlane = Eigen::Matrix<double, 6, 1>;
  const InPlane scales = trimScales().head<6>();
  for (int i = 0; i < 6; ++i) {
    FlapState change = FlapState::Zero();
    change(i) = 0.02 * scales(i);
    const InPlane flown =
        ((end(start + change, wingbeat) - end(start - change, wingbeat)) / 2.0).head<6>();
    const InPlane linear = A.block<6, 1>(0, i) * change(i);
    EXPECT_LT((flown - linear).cwiseQuotient(scales).norm(),
              0.05 * flown.cwiseQuotient(scales).norm() + 1e-3)
        << kStateNames[i];
  }
  for (std::size_t i = 0; i < 2; ++i) {
    WingbeatStart more = wingbeat, less = wingbeat;
    constexpr double kStep = 0.002;
    more.command.*kCommandTable[d.options.inputs[i]].value += kStep;
    less.command.*kCommandTable[d.options.inputs[i]].value -= kStep;
    const InPlane flown = ((end(start, more) - end(start, less)) / 2.0).head<6>();
    const InPlane linear = B.block<6, 1>(0, static_cast<Eigen::Index>(i)) * kStep;
    EXPECT_LT((flown - linear).cwiseQuotient(scales).norm(),
              0.05 * flown.cwiseQuotient(scales).norm())
        << i;
  }
  // Floquet multipliers are those of the map over a flap.
  std::ostringstream log;
  TrimOptions trim_options;
  trim_options.newton.max_iterations = 0;
  trim_options.start = start;
  const TrimResult flap = trim(d.c, CONFIG_DIR, trim_options, log);
  EXPECT_NEAR(std::abs(d.design.in_plane.open_loop.front()),
              std::abs(flap.floquet.front().multiplier), 0.03);
}

TEST(ControlDesign, KeepsAMonarchInTheAirThatTumblesWithoutIt) {
  const Designed& d = Designed::get();
  EXPECT_GT(std::abs(d.design.in_plane.open_loop.front()), 1.3);
  EXPECT_LT(std::abs(d.design.in_plane.closed_loop.front()), 0.95);
  const SetPoint own = ownSetPoint(d.c);
  ControlledStart start;
  start.flaps = 12;
  start.change.head<6>() << 0.2, 0.1, 0.12, 1.0, 0.1, 2.0;
  const WingbeatSettings wingbeat = wingbeatSettings(d.c, d.options);
  const ControlledFlight held = flyControlled(d.c, wingbeat, d.design.settings, start);
  ASSERT_TRUE(held.complete) << held.failure;
  EXPECT_FALSE(held.lost);
  for (const ControlledFlap& flap : held.flaps) {
    EXPECT_LT(flap.theta_B_high, 1.0);
    EXPECT_GT(flap.theta_B_low, -0.7);
  }
  EXPECT_NEAR(held.flaps.back().speed, own.speed, 0.02);
  EXPECT_NEAR(held.flaps.back().climb, own.climb, 0.02);
  start.uncontrolled = true;
  const ControlledFlight alone = flyControlled(d.c, wingbeat, d.design.settings, start);
  double largest = 0.0;
  for (const ControlledFlap& flap : alone.flaps)
    largest = std::max({largest, flap.theta_B_high, -flap.theta_B_low});
  EXPECT_GT(largest, 1.5);
}

TEST(ControlDesign, HoldsWithCommandedFrequencyOnThePhaseClock) {
  ControlOptions options = Designed::get().options;
  options.inputs = {kFrequencyCommand, kDeviationMeanCommand};
  options.samples = 4;
  std::ostringstream log;
  const Case& c = Designed::get().c;
  const ControlDesign design = designController(c, options, log);
  ControlledStart start;
  start.flaps = 10;
  start.change.head<6>() << -0.15, 0.1, 0.1, 0.0, 0.0, 0.0;
  const ControlledFlight held =
      flyControlled(c, wingbeatSettings(c, options), design.settings, start);
  ASSERT_TRUE(held.complete) << held.failure;
  EXPECT_FALSE(held.lost);
  EXPECT_NEAR(held.flaps.back().speed, ownSetPoint(c).speed, 0.03);
  EXPECT_NEAR(held.flaps.back().climb, ownSetPoint(c).climb, 0.03);
}

class ControlCase : public CaseTest {};

TEST_F(ControlCase, SectionIsReadAsItWasDesigned) {
  const Designed& d = Designed::get();
  const std::string section = guidanceSection(d.c, d.design);
  for (const char* part : {"status: computed by monarch trim control:=true", "quasi-steady air",
                           "200 steps a flap", "Floquet multipliers"})
    expectHas(section, part);
  const std::string text = withGuidance(d.c, section);
  const Case read = caseFromText(text, "controlled", {}, CONFIG_DIR);
  ASSERT_TRUE(read.guidance.controller);
  const ControllerSettings &a = *read.guidance.controller, &b = d.design.settings;
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.gains.inputs, b.gains.inputs);
  EXPECT_LT((a.gains.state - b.gains.state).norm(), 1e-7 * b.gains.state.norm());
  EXPECT_LT((a.gains.filter - b.gains.filter).norm(), 1e-7 * b.gains.filter.norm());
  EXPECT_LT((a.gains.integral - b.gains.integral).norm(), 1e-7 * b.gains.integral.norm());
  EXPECT_LT((a.table.states() - b.table.states()).norm(), 1e-7 * b.table.states().norm());
  EXPECT_NEAR(a.set_points[0].climb, b.set_points[0].climb, 1e-10);
  EXPECT_EQ(a.first_step, 10u);
  // The resolved case is a case again.
  const Case again = caseFromText(read.resolved_yaml, "again", {}, CONFIG_DIR);
  EXPECT_EQ(again.sha256, read.sha256);
  expectHas(refusal(text, "samples: 10", "samples: 7"), "must divide the 200 steps of a flap");
  // Names first and alone: what they mean for the rows is not known.
  const auto alone = [&](const std::string& what, const std::string& by, const std::string& told) {
    const std::string why = refusal(text, what, by);
    expectHas(why, "changed: 1 fault\n");
    expectHas(why, told);
  };
  alone("inputs: amplitude, dev", "inputs: amplitud, dev", "'amplitud': must be commands of");
  alone("inputs: amplitude, deviation_mean", "inputs: ','", "',': must name a command");
  alone("    inputs: amplitude", "    input: amplitude", "controller/input is not a known key");
  expectHas(refusal(text, "time_constant: 0.06", "time_constant: 0.2"), "gains were made");
  expectHas(refusal(text, "      flaps: [0]", "      flaps: [0, 3]"), "must be as many");
  expectHas(refusal(text, "pitch: true", "pitch: false"), "no free flight to control");
}

TEST_F(ControlCase, WrongKeysAreRefused) {
  const auto refusal = [](const std::vector<std::string>& arguments) -> std::string {
    try {
      trimCommand(arguments);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  expectHas(refusal({"control:=yes"}), "true or false");
  expectHas(refusal({"control:=true", "inputs:=amplitude,wings"}), "inputs:=wings");
  expectHas(refusal({"control:=true", "fit:=kappa:1e-4:2e-4"}), "fit: is for a trim");
  expectHas(refusal({"samples:=4"}), "samples:=4: unknown key");
  EXPECT_EQ(refusal({"control:=true", "samples:=4", "speeds:=1,1.2", "orbit:=own"}), "");
}

/// A controlled case has rows of numbers; written anew it is the same case.
TEST(CaseEdit, WritesRowsOfNumbersSoThatTheyAreReadAgain) {
  const Case c = loadCase("climb_controlled", {}, CONFIG_DIR);
  const std::string text = CaseEdit(c.resolved_yaml).text();
  EXPECT_EQ(caseFromText(text, "again", {}, CONFIG_DIR).resolved_yaml, c.resolved_yaml);
}

}  // namespace
}  // namespace monarch_flight
