// Whole runs in one process with the quasi-steady air: convergence, repeatability, and how a run
// ends.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "monarch_flight/insect/start_motion.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/state_hash.h"

namespace monarch_flight {
namespace {

Case quasiSteady(const std::string& name, CaseOverrides overrides) {
  overrides["fluid"] = "quasi_steady";
  return loadCase(name, overrides, CONFIG_DIR);
}

// Keeps what the tests ask for; throws at `throw_at`.
class Recorder : public StepSink {
 public:
  void onStep(const CommittedStep& step) override {
    if (step.step == throw_at) throw std::runtime_error("table: disk full");
    steps.push_back(step);
    hash.add(step);
  }
  void onReset() override { ADD_FAILURE() << "nobody asked for it"; }
  void onEnd(const std::string& failure) override {
    ++ends;
    end_failure = failure;
    if (!throw_at_end.empty()) throw std::runtime_error(throw_at_end);
  }

  std::uint32_t throw_at = ~0u;
  std::string throw_at_end, end_failure;
  std::vector<CommittedStep> steps;
  StateHash hash{true};
  int ends = 0;
};

RunResult fly(const Case& c, std::vector<StepSink*> sinks, const StopFlag& stop = false) {
  InProcessFederation federation(c);
  return federation.run(7, sinks, stop);
}

/// (x, z, theta_B, theta_R) after a quarter of a flap, released at once from explicit initial
/// values whose accelerations are far from those of the flight; `believed`: taken for those of the
/// flight.
Eigen::Vector4d quarterFlap(int steps_per_flap, bool believed) {
  Case c = quasiSteady("climb_trimmed", {{"steps_per_flap", std::to_string(steps_per_flap)}});
  c.coupling.prescribed_steps = 0;
  c.coupling.accelerations_known = believed;
  c.time.steps = static_cast<std::uint32_t>(steps_per_flap) / 4;
  const PrescribedState s = c.motion->at(c.time.t_start);
  StartValues start;
  start.x = StartValue{0.0, s.body.v.x(), 0.0};
  start.z = StartValue{0.0, s.body.v.z(), 0.0};
  start.pitch = StartValue{s.body.pitch.q, s.body.pitch.qd, 0.0};
  start.theta_R = StartValue{s.angles.wings.right.theta.q, s.angles.wings.right.theta.qd, 0.0};
  c.motion = std::make_shared<StartMotion>(c.motion, start, c.time.t_start);
  Recorder recorder;
  const RunResult result = fly(c, {&recorder});
  EXPECT_TRUE(result.complete) << result.failure;
  const Interface& end = recorder.steps.back().interface;
  return {end.body.x.x(), end.body.x.z(), end.body.pitch.q, end.theta.right.q};
}

TEST(Federation, AReleasedFlightIsOfSecondOrderInTheTimeStep) {
  const auto order = [](bool believed) -> Eigen::Array4d {
    const Eigen::Vector4d middle = quarterFlap(800, believed);
    const Eigen::Array4d first = quarterFlap(400, believed) - middle;
    const Eigen::Array4d second = middle - quarterFlap(1600, believed);
    return (first / second).abs().log() / std::log(2.0);
  };
  EXPECT_LT((order(false) - 2.0).abs().maxCoeff(), 0.2) << order(false).transpose();
  EXPECT_LT(order(true).minCoeff(), 1.2) << order(true).transpose();
}

TEST(Federation, TwoFlapsOfTheClimbConvergeInEveryStepAndRepeat) {
  const Case c = quasiSteady("climb_printed", {{"flaps", "2"}, {"steps_per_flap", "500"}});
  Recorder first, second;
  const RunResult result = fly(c, {&first});
  ASSERT_TRUE(result.complete) << result.failure;
  ASSERT_EQ(first.steps.size(), 1001u);
  EXPECT_EQ(first.ends, 1);
  EXPECT_EQ(first.end_failure, "");
  const Matrix6d M = first.steps[0].fluid.added_mass;
  EXPECT_EQ(M, makeFluid(c)->addedMass());
  EXPECT_GT(M(2, 2), 0.0);
  for (std::uint32_t n = 0; n < first.steps.size(); ++n) {
    const CommittedStep& s = first.steps[n];
    EXPECT_EQ(s.step, n);
    EXPECT_DOUBLE_EQ(s.t, c.time.time(n));
    EXPECT_FALSE(s.retried());
    EXPECT_EQ(s.prescribed, n <= 10) << n;
    if (s.prescribed) continue;
    for (double residual : s.iterations.back().residual) EXPECT_LE(std::abs(residual), 1e-8);
    EXPECT_LE(s.iterations.size(), 5u);  // the bar of the default strategy
  }
  ASSERT_TRUE(fly(c, {&second}).complete);
  EXPECT_EQ(first.hash.hex(), second.hash.hex());

  Recorder other;
  const Case shorter = quasiSteady("climb_printed", {{"flaps", "2"}, {"steps_per_flap", "400"}});
  ASSERT_TRUE(fly(shorter, {&other}).complete);
  EXPECT_NE(first.hash.hex(), other.hash.hex());
}

TEST(Federation, EveryStrategyFliesTheSameFlight) {
  Case c = quasiSteady("climb_printed", {{"flaps", "0.3"}, {"steps_per_flap", "500"}});
  c.coupling.tolerance = 1e-10;
  c.coupling.load_tolerance = 1e-8;
  Recorder reference;
  c.coupling.relaxation = Relaxation::kAddedMass;
  ASSERT_TRUE(fly(c, {&reference}).complete);
  for (Relaxation relaxation : {Relaxation::kAitken, Relaxation::kIqnIls}) {
    Recorder r;
    c.coupling.relaxation = relaxation;
    const RunResult result = fly(c, {&r});
    ASSERT_TRUE(result.complete) << result.failure;
    for (std::size_t n = 0; n < r.steps.size(); ++n) {
      const Interface &a = r.steps[n].interface, &b = reference.steps[n].interface;
      ASSERT_NEAR(a.theta.right.q, b.theta.right.q, 1e-7) << n;
      ASSERT_NEAR(a.body.pitch.q, b.body.pitch.q, 1e-7) << n;
      ASSERT_LT((a.body.x - b.body.x).norm(), 1e-7 * c.coupling.length_scale) << n;
    }
  }
}

// Navier-Stokes on a grid of a few thousand cells: loads predicted by the operator against a full
// solve in every sub-iteration, and each of them against itself.
TEST(Federation, NavierStokesFliesTheSameFlightByOperatorAndByFullSolves) {
  Case c = loadCase("climb_printed", {{"flaps", "0.06"}, {"steps_per_flap", "500"}}, CONFIG_DIR);
  c.grid.cells_per_chord = 5;
  c.grid.first_cell = 0.1;
  c.grid.far_field = 3.0;
  c.grid.growth_plane = c.grid.growth_normal = 1.4;
  c.coupling.tolerance = 1e-10;
  c.coupling.load_tolerance = 1e-8;
  Recorder first, again, full;
  ASSERT_TRUE(fly(c, {&first}).complete);
  ASSERT_TRUE(fly(c, {&again}).complete);
  EXPECT_EQ(first.hash.hex(), again.hash.hex());
  c.coupling.relaxation = Relaxation::kAitken;
  ASSERT_TRUE(fly(c, {&full}).complete);
  int predicted = 0, solved = 0;
  for (std::size_t n = 0; n < full.steps.size(); ++n) {
    const Interface &a = first.steps[n].interface, &b = full.steps[n].interface;
    ASSERT_NEAR(a.theta.right.q, b.theta.right.q, 1e-7) << n;
    ASSERT_NEAR(a.body.pitch.q, b.body.pitch.q, 1e-7) << n;
    ASSERT_LT((a.body.x - b.body.x).norm(), 1e-7 * c.coupling.length_scale) << n;
    predicted += first.steps[n].fluid_evaluations;
    solved += full.steps[n].fluid_evaluations;
  }
  EXPECT_LT(predicted, solved);
}

// The loads of the free flight move the whole insect: momentum of the system against loads and
// weight.
TEST(Federation, ImpulseOfAirAndWeightIsTheChangeOfMomentum) {
  const Case c = quasiSteady("climb_printed", {{"flaps", "1"}, {"steps_per_flap", "2000"}});
  Recorder r;
  ASSERT_TRUE(fly(c, {&r}).complete);
  const Insect& insect = c.insect;
  const auto momentum = [&](const CommittedStep& s) {
    const BodyState& b = s.interface.body;
    Eigen::Vector3d p = insect.m_B * b.v;
    const auto add = [&](const Appendage& a, const Eigen::Matrix3d& Q,
                         const Eigen::Vector3d& rate) {
      const Eigen::Vector3d relative = Q * rate.cross(a.nu);  // F_B
      p += a.m * (b.v + b.R_IB() * (b.Omega_B.cross(a.mu + Q * a.nu) + relative));
    };
    const auto& [right, left] = s.angles.wings;
    const Eigen::Vector3d w = wingRate(left);
    add(insect.wings.right.plate, wingAttitude(Side::kRight, insect.beta, right), wingRate(right));
    add(mirrored(insect.wings.left.plate), wingAttitude(Side::kLeft, insect.beta, left),
        {-w.x(), w.y(), -w.z()});
    add(insect.abdomen, abdomenAttitude(s.angles), {0.0, s.angles.theta_A.qd, 0.0});
    return p;
  };
  const std::size_t first = 200, last = 2000;  // the start is prescribed
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  for (std::size_t n = first; n < last; ++n)
    impulse += 0.5 * c.time.dt * (r.steps[n].force_I + r.steps[n + 1].force_I);
  impulse.z() += insect.totalMass() * c.gravity * c.time.dt * static_cast<double>(last - first);
  const Eigen::Vector3d change = momentum(r.steps[last]) - momentum(r.steps[first]);
  EXPECT_LT((impulse - change).norm(), 1e-3 * (impulse.norm() + change.norm()));
}

TEST(Federation, TetheredFlightLiftsAboutTheWeight) {
  const Case c = quasiSteady("tethered_fwuav", {{"flaps", "2"}});
  Recorder r;
  ASSERT_TRUE(fly(c, {&r}).complete);
  const auto n = static_cast<std::size_t>(std::lround(c.time.stepsPerFlap()));
  ASSERT_EQ(r.steps.size(), 2 * n + 1);
  double up = 0.0;
  for (std::size_t i = n + 1; i <= 2 * n; ++i) {
    EXPECT_TRUE(r.steps[i].prescribed);
    EXPECT_EQ(r.steps[i].iterations.size(), 1u);
    up -= r.steps[i].force_I.z() / static_cast<double>(n);
  }
  EXPECT_GT(up, 1e-3);  // weight 3.0 mN
  EXPECT_LT(up, 1e-2);
}

TEST(Federation, SinkThatFailsEndsTheRunWithItsMessage) {
  const Case c = quasiSteady("climb_printed", {{"flaps", "1"}, {"steps_per_flap", "200"}});
  Recorder failing, other;
  failing.throw_at = 5;
  const RunResult result = fly(c, {&failing, &other});
  EXPECT_FALSE(result.complete);
  EXPECT_EQ(result.failure, "table: disk full");
  EXPECT_EQ(other.steps.size(), 5u);
  EXPECT_EQ(failing.ends + other.ends, 2);
  EXPECT_EQ(other.end_failure, "table: disk full");
}

TEST(Federation, SinkThatFailsAtTheEndIsKnownToThoseBehindIt) {
  const Case c = quasiSteady("climb_printed", {{"flaps", "1"}, {"steps_per_flap", "200"}});
  Recorder failing, other;
  failing.throw_at_end = "bag: disk full";
  const RunResult result = fly(c, {&failing, &other});
  EXPECT_FALSE(result.complete);
  EXPECT_EQ(result.failure, "bag: disk full");
  EXPECT_EQ(other.end_failure, "bag: disk full");
}

TEST(Federation, StopEndsTheRunBeforeItsFirstStep) {
  const Case c = quasiSteady("climb_printed", {{"flaps", "1"}, {"steps_per_flap", "200"}});
  Recorder r;
  const StopFlag stop{true};
  const RunResult result = fly(c, {&r}, stop);
  EXPECT_FALSE(result.complete);
  EXPECT_NE(result.failure.find("interrupted"), std::string::npos) << result.failure;
  EXPECT_EQ(r.steps.size(), 1u);
  EXPECT_EQ(r.ends, 1);
}

TEST(Federation, MakesTheFluidThatTheCaseNames) {
  const Case c = quasiSteady("climb_printed", {});
  EXPECT_EQ(makeFluid(c)->cells(), 0);
  const CoupledModel model = makeModel(c);
  EXPECT_EQ(model.steps, c.time.steps);
  EXPECT_EQ(model.newmark.dt, c.time.dt);
  EXPECT_EQ(model.gravity, c.gravity);
  EXPECT_EQ(picturesOf(c).flow_points, c.output.flow_points);
}

}  // namespace
}  // namespace monarch_flight
