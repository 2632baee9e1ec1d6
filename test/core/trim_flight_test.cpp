// Trim of whole cases in quasi-steady air: an exact pendulum, the monarch, wrong input.
#include <cmath>
#include <sstream>

#include "case_fixture.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/trim/command.h"
#include "monarch_flight/trim/periodic_shape.h"

namespace monarch_flight {
namespace {

// A bare wing at rest on its hinge in almost no air, without gravity: a linear torsional pendulum.
constexpr char kPendulum[] = R"(
name: pendulum
insect:
  kind: bare_wing
  name: plate
  beta: 0
  wing:
    mass: 1.0
    kappa: 20.0
    theta_0: 0.3
    planform: {type: rectangle, chord: 1, span: 2, hinge: 0, root_offset: 0}
fluid: {solver: quasi_steady, density: 1.0e-12, gravity: 0}
motion:
  type: fourier
  frequency: 1.0
  phi_deg: 0
  psi_deg: 0
  theta_R_deg: 0
  theta_B_deg: 0
  body: {position: [0, 0, 0], velocity: [0, 0, 0]}
free: {x: false, z: false, pitch: false, wing_pitch: true}
time: {steps_per_flap: 100, flaps: 1}
)";

class Trim : public CaseTest {};

TEST_F(Trim, PendulumRestsAndItsMultipliersAreExact) {
  const Case c = loadCase(write("pendulum.yaml", kPendulum), {}, CONFIG_DIR);
  TrimOptions options;
  options.newton.tolerance = 1e-7;
  std::ostringstream log;
  const TrimResult r = trim(c, CONFIG_DIR, options, log);
  ASSERT_TRUE(r.newton.converged) << r.newton.reason << '\n' << log.str();
  EXPECT_NEAR(r.point.state(4), 0.3, 1e-7);
  EXPECT_NEAR(r.point.state(5), 0.0, 1e-5);
  // Newmark's average acceleration turns by 2 atan(w dt / 2) a step, without damping.
  const double w = std::sqrt(c.insect.wings.right.kappa / c.insect.wings.right.plate.J(1, 1));
  const double phase = 100.0 * 2.0 * std::atan(0.5 * w * c.time.dt);
  ASSERT_EQ(r.floquet.size(), 2u);
  for (const FloquetMode& mode : r.floquet) {
    EXPECT_NEAR(std::abs(mode.multiplier), 1.0, 1e-3);
    EXPECT_NEAR(mode.multiplier.real(), std::cos(phase), 2e-3);
    EXPECT_NEAR(std::abs(mode.multiplier.imag()), std::abs(std::sin(phase)), 2e-3);
  }
}

TEST_F(Trim, MonarchFliesPeriodicallyFromThePrintedParameters) {
  const CaseOverrides overrides{{"fluid", "quasi_steady"}, {"steps_per_flap", "200"}};
  const Case c = loadCase("climb_printed", overrides, CONFIG_DIR);
  TrimOptions options;
  options.newton.tolerance = 1e-5;
  std::ostringstream log;
  const TrimResult r = trim(c, CONFIG_DIR, options, log);
  ASSERT_TRUE(r.newton.converged) << r.newton.reason << '\n' << log.str();

  const FlapMap map(c, CONFIG_DIR, {}, 0);
  const Flight flight = map.fly(r.point, 3);
  ASSERT_TRUE(flight.complete) << flight.failure;
  for (const Flap& flap : flight.flaps) {
    EXPECT_LT((flap.end - flap.start).cwiseQuotient(trimScales()).cwiseAbs().maxCoeff(), 1e-3);
  }
  // The unstable mode grows by its multiplier, as flown.
  const FloquetMode& mode = r.floquet.front();
  ASSERT_GT(std::abs(mode.multiplier), 1.0);
  constexpr double kSmall = 0.02;
  TrimPoint off = r.point;
  FlapState expected = FlapState::Zero(), inactive = FlapState::Ones();
  for (std::size_t i = 0; i < map.active().size(); ++i) {
    const int k = map.active()[i];
    const std::complex<double> part = mode.mode(static_cast<Eigen::Index>(i));
    off.state(k) += kSmall * part.real() * trimScales()(k);
    expected(k) = kSmall * (mode.multiplier * part).real();
    inactive(k) = 0.0;
  }
  const Flight away = map.fly(off, 1);
  ASSERT_TRUE(away.complete);
  FlapState grown = (away.flaps[0].end - flight.flaps[0].end).cwiseQuotient(trimScales());
  grown = (inactive.array() == 0.0).select(grown, 0.0);
  EXPECT_LT((grown - expected).norm(), 0.1 * expected.norm());
}

TEST_F(Trim, ResultIsACaseThatFliesTheSameFlight) {
  const CaseOverrides overrides{{"fluid", "quasi_steady"}, {"steps_per_flap", "200"}};
  const Case c = loadCase("climb_printed", overrides, CONFIG_DIR);
  TrimOptions options;
  options.start = FlapState::Zero();
  options.start->head<6>() << 0.62, -0.45, 0.242, 16.3, 0.05, 16.8;
  std::ostringstream log;
  options.newton.tolerance = 1e-5;
  const TrimResult r = trim(c, CONFIG_DIR, options, log);
  ASSERT_TRUE(r.newton.converged);
  const FlapMap map(c, CONFIG_DIR, {}, 0);
  const std::string text = trimmedCase(map, options, r, 200, 2);
  expectHas(text, "status: fitted by trim");
  const Case stored = loadCase(write("stored.yaml", text), {}, CONFIG_DIR);
  EXPECT_EQ(stored.coupling.prescribed_steps, 200);
  EXPECT_EQ(stored.time.steps, 600u);
  const PrescribedState release = stored.motion->at(stored.time.time(200));
  EXPECT_NEAR(release.body.v.x(), r.point.state(0), 1e-12);
  EXPECT_NEAR(release.body.v.z(), r.point.state(1), 1e-12);
  EXPECT_NEAR(release.body.pitch.q, r.point.state(2), 1e-12);
  EXPECT_NEAR(release.body.pitch.qd, r.point.state(3), 1e-9);
  EXPECT_NEAR(release.angles.wings.right.theta.q, r.point.state(4), 1e-12);
  EXPECT_NEAR(release.angles.wings.right.theta.qd, r.point.state(5), 1e-9);
  // A release within the flap is on the same flight.
  const Case early = caseFromText(trimmedCase(map, options, r, 10, 2), "early", {}, CONFIG_DIR);
  double mean = 0.0;
  for (int k = 0; k < 200; ++k) mean += early.motion->at(early.time.time(k)).body.pitch.q / 200.0;
  EXPECT_NEAR(mean, r.flaps.front().theta_B_mean, 1e-3);
  const FlapMap with_run_in(c, CONFIG_DIR, {}, 1);
  const Flight flight = with_run_in.fly(r.point, 2);
  ASSERT_TRUE(flight.complete) << flight.failure;
  EXPECT_NEAR(flight.flaps[1].speed, r.flaps.front().speed, 0.05);
}

TEST_F(Trim, HorizonHoldsEveryFlapOfAnUnstableFlight) {
  const CaseOverrides overrides{{"fluid", "quasi_steady"}, {"steps_per_flap", "200"}};
  const Case c = loadCase("climb_printed", overrides, CONFIG_DIR);
  TrimOptions options;
  std::ostringstream log;
  options.newton.tolerance = 1e-5;
  const TrimResult periodic = trim(c, CONFIG_DIR, options, log);
  ASSERT_TRUE(periodic.newton.converged);
  const Flap& sought = periodic.flaps.front();
  options.targets = {{TrimTarget::kClimb, sought.climb, 0.03},
                     {TrimTarget::kSpeed, sought.speed, 0.1},
                     {TrimTarget::kPitch, sought.theta_B_mean, 0.03}};
  options.start = periodic.point.state;
  (*options.start)(0) += 0.05;
  (*options.start)(2) -= 0.03;
  options.horizon = 4;
  options.newton.least_squares = true;
  options.newton.weight = 0.5;
  options.newton.step_tolerance = 1e-3;
  const TrimResult r = trim(c, CONFIG_DIR, options, log);
  ASSERT_TRUE(r.newton.converged) << r.newton.reason << '\n' << log.str();
  ASSERT_EQ(r.flaps.size(), 4u);
  for (const Flap& flap : r.flaps) {
    EXPECT_NEAR(flap.climb, sought.climb, 0.01);
    EXPECT_NEAR(flap.speed, sought.speed, 0.01);
    EXPECT_NEAR(flap.theta_B_mean, sought.theta_B_mean, 0.01);
  }
  // The rows of later flaps follow from those of the first.
  const Eigen::MatrixXd one = r.newton.jacobian.topRows(6 + 3);
  const Eigen::MatrixXd all = overHorizon(one, 6, 3, 4);
  EXPECT_LT((all - r.newton.jacobian).norm(), 0.1 * r.newton.jacobian.norm());
  EXPECT_THROW(overHorizon(one.topRows(8), 6, 3, 4), InputError);
  expectHas(trimmedCase(FlapMap(c, CONFIG_DIR, {}, 0), options, r, 200, 4), "to 4 free flaps");
}

TEST(PeriodicShape, SeriesOfSamplesAndThroughAState) {
  constexpr double kPeriod = 0.1, kStart = 0.013;
  FourierSeries exact{0.2, {0.3, -0.1}, {0.05, 0.4}, 1};
  std::vector<double> samples;
  for (int k = 0; k <= 60; ++k) {
    const double s = kPeriod * k / 60;
    samples.push_back(exact.at(1.0 / kPeriod, kStart + s).q + 7.0 * s);
  }
  const FourierSeries found = periodicSeries(samples, kPeriod, kStart, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(found.an[i], exact.an[i], 1e-12);
    EXPECT_NEAR(found.bn[i], exact.bn[i], 1e-12);
  }
  const Coordinate at = through(found, 1.0 / kPeriod, kStart, -0.7, 9.0).at(1.0 / kPeriod, kStart);
  EXPECT_NEAR(at.q, -0.7, 1e-12);
  EXPECT_NEAR(at.qd, 9.0, 1e-10);
}

std::string commandFaults(const std::vector<std::string>& arguments) {
  try {
    trimCommand(arguments);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST_F(Trim, WrongInputIsRefusedWithEveryFault) {
  const std::string all = commandFaults({"fit:=kapa:1:2", "climb:=steep", "start:=1,2", "wing:=4",
                                         "tolerance:=-1", "threads:=1.5", "plain"});
  for (const char* part : {"fit:=kapa:1:2", "climb:=steep", "start:=1,2", "wing:=4",
                           "tolerance:=-1", "threads:=1.5", "'plain'"}) {
    expectHas(all, part);
  }
  expectHas(commandFaults({"fit:=kappa:2e-4:1e-4"}), "low must be below high");
  expectHas(commandFaults({"horizon:=3"}), "needs targets");
  expectHas(commandFaults({"fit:=kappa:1e-4:2e-4,kappa:1e-4:3e-4"}), "kappa is given twice");
  EXPECT_EQ(commandFaults({"case:=climb_printed", "fit:=kappa:1e-4:2e-4", "climb:=23.4"}), "");
}

TEST_F(Trim, CasesThatCannotBeTrimmedAreRefused) {
  const auto refusal = [](const std::string& name, const TrimOptions& options) -> std::string {
    std::ostringstream log;
    try {
      trim(loadCase(name, {{"fluid", "quasi_steady"}}, CONFIG_DIR), CONFIG_DIR, options, log);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  expectHas(refusal("tethered_fwuav", {}), "nothing is free");
  TrimOptions options;
  options.parameters = {trimParameters()[3]};
  options.parameters[0].low = 1e-5;
  options.parameters[0].high = 1e-4;  // the case has 1.5e-4
  expectHas(refusal("climb_printed", options), "widen the range");
}

}  // namespace
}  // namespace monarch_flight
