// Coordinator and strategies on air of a known law, up to twenty times the mass of a wing's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/coupling_fakes.h"
#include "monarch_flight/coupling/interface_balance.h"
#include "monarch_flight/coupling/interface_values.h"

namespace monarch_flight {
namespace {

using testing::both;
using testing::Federation;
using testing::monarchAir;

const FreeCoordinates kAllFree = {kX, kZ, kPitch, kThetaR};
constexpr std::uint32_t kSteps = 150;

CouplingSettings with(Relaxation relaxation) {
  CouplingSettings settings = testing::couplingSettings();
  settings.relaxation = relaxation;
  return settings;
}

double distance(const Interface& a, const Interface& b) {
  return testing::dimensionlessDistance(a, b, 0.0209);
}

struct Count {
  double mean = 0.0, evaluations = 0.0;
  std::size_t max = 0, retried = 0;
};

/// Over the solved steps.
Count count(const testing::KeepingSink& sink) {
  Count c;
  int n = 0;
  for (const CommittedStep& step : sink.steps) {
    if (step.prescribed) continue;
    ++n;
    c.mean += static_cast<double>(step.iterations.size());
    c.evaluations += step.fluid_evaluations;
    c.max = std::max(c.max, step.iterations.size());
    c.retried += step.iterations.back().attempt > 1;
  }
  c.mean /= n;
  c.evaluations /= n;
  return c;
}

class HeavyAir : public ::testing::TestWithParam<double> {};

/// Full solves in every sub-iteration or loads predicted through the operator: the same flight.
TEST_P(HeavyAir, AllStrategiesFlyTheSameFlight) {
  const CoupledModel model = testing::coupledModel(kAllFree, kSteps);
  CouplingSettings tight = with(Relaxation::kAddedMass);
  tight.tolerance = 1e-12;
  tight.load_tolerance = 1e-9;
  Federation reference(model, tight, monarchAir(GetParam()));
  ASSERT_TRUE(reference.run().complete);
  for (Relaxation relaxation : {Relaxation::kAitken, Relaxation::kIqnIls, Relaxation::kAddedMass}) {
    CouplingSettings settings = with(relaxation);
    settings.max_sub_iterations = 200;
    settings.load_tolerance = 1e-8;
    Federation f(model, settings, monarchAir(GetParam()));
    const CoupledOutcome outcome = f.run();
    ASSERT_TRUE(outcome.complete) << outcome.failure;
    for (std::uint32_t i = 0; i <= kSteps; ++i) {
      ASSERT_LT(distance(f.sink.steps[i].interface, reference.sink.steps[i].interface), 1e-7)
          << "step " << i << " of strategy " << static_cast<int>(relaxation);
    }
  }
}

TEST_P(HeavyAir, AddedMassNeedsTwoTrialsWhateverTheAirWeighs) {
  const CoupledModel model = testing::coupledModel(kAllFree, kSteps);
  CouplingSettings settings = with(Relaxation::kAddedMass);
  settings.operator_every = 100;
  Federation f(model, settings, monarchAir(GetParam()));
  ASSERT_TRUE(f.run().complete);
  const Count c = count(f.sink);
  EXPECT_LE(c.mean, 2.05);
  EXPECT_LE(c.max, 3u);
  EXPECT_EQ(c.retried, 0u);
  EXPECT_LE(c.evaluations, 2.2);
  EXPECT_EQ(f.air->operators, 2);  // the first solved step, and after a hundred
  EXPECT_EQ(c.evaluations * (kSteps - 10), f.air->evaluations - 10 + 6 * f.air->operators);
}

INSTANTIATE_TEST_SUITE_P(Ratios, HeavyAir, ::testing::Values(0.5, 2.0, 8.0, 20.0));

TEST(Strategies, IqnIlsLearnsFromEarlierSteps) {
  const CoupledModel model = testing::coupledModel(kAllFree, kSteps);
  CouplingSettings forgetful = with(Relaxation::kIqnIls);
  forgetful.reuse_steps = 0;
  Federation reusing(model, with(Relaxation::kIqnIls), monarchAir(5.0));
  Federation fresh(model, forgetful, monarchAir(5.0));
  ASSERT_TRUE(reusing.run().complete);
  ASSERT_TRUE(fresh.run().complete);
  EXPECT_LT(count(reusing.sink).mean, 0.75 * count(fresh.sink).mean);
}

TEST(Strategies, AFlightThatIsFreeFromTheFirstStepAsksTwice) {
  CouplingSettings settings = with(Relaxation::kAddedMass);
  settings.prescribed_steps = 0;
  Federation f(testing::coupledModel(kAllFree, 30), settings, monarchAir(2.0));
  ASSERT_TRUE(f.run().complete);
  EXPECT_EQ(f.air->operators, 2);
  Federation cheap(testing::coupledModel(kAllFree, 30), settings, monarchAir(2.0));
  cheap.air->operator_cost = 0;
  ASSERT_TRUE(cheap.run().complete);
  EXPECT_EQ(cheap.air->operators, 30);
  EXPECT_EQ(count(cheap.sink).evaluations, count(cheap.sink).mean);
}

TEST(Strategies, AWrongOperatorIsPutRightByTheTrialsOfTheStep) {
  // The air answers as if it weighed a third more than its operator says.
  const CoupledModel model = testing::coupledModel(kAllFree, kSteps);
  Federation f(model, with(Relaxation::kAddedMass), monarchAir(4.0));
  f.fluid->change = [](Reply& reply) {
    if (!reply.jacobian) return;
    reply.jacobian->velocity *= 0.75;
    reply.jacobian->acceleration *= 0.75;
  };
  ASSERT_TRUE(f.run().complete);
  EXPECT_LE(count(f.sink).max, 7u);
  EXPECT_EQ(count(f.sink).retried, 0u);
}

TEST(Strategies, PlainFixedPointDivergesAboveRatioOneAndSaysSo) {
  const CoupledModel model = testing::coupledModel(kAllFree, 20);
  CouplingSettings plain = with(Relaxation::kConstant);
  plain.omega_initial = 1.0;
  Federation light(model, plain, monarchAir(0.2)), heavy(model, plain, monarchAir(20.0));
  EXPECT_TRUE(light.run().complete);
  EXPECT_EQ(count(light.sink).retried, 0u);
  EXPECT_LT(light.sink.steps.back().added_mass_ratio, 1.0);
  const CoupledOutcome outcome = heavy.run();
  EXPECT_FALSE(outcome.complete);
  EXPECT_GT(heavy.sink.steps.back().added_mass_ratio, 4.0);
  for (const char* words : {"step 11", "theta_R", "largest residual of the last",
                            "added-mass ratio", "set coupling/relaxation to added_mass"}) {
    EXPECT_NE(outcome.failure.find(words), std::string::npos) << outcome.failure;
  }
}

TEST(Retry, AFailureOfASolverIsTriedOnceMore) {
  const CoupledModel model = testing::coupledModel(kAllFree, 30);
  for (bool infinite : {false, true}) {
    Federation f(model, with(Relaxation::kAddedMass), monarchAir(1.0));
    int failures = 0;
    f.fluid->change = [&](Reply& reply) {
      if (reply.key.step != 15 || reply.key.phase != Phase::kIterate || failures > 0) return;
      ++failures;
      if (infinite) {
        reply.loads.force_pressure.z() = std::numeric_limits<double>::infinity();
      } else {
        reply.error = "the air broke";
      }
    };
    const CoupledOutcome outcome = f.run();
    ASSERT_TRUE(outcome.complete) << outcome.failure;
    const auto& records = f.sink.steps[15].iterations;
    EXPECT_EQ(records.front().attempt, 1u);
    EXPECT_TRUE(std::isinf(records.front().residual[kThetaR]));
    EXPECT_EQ(records.back().attempt, 2u);
    EXPECT_LT(records.back().load_residual, 1e-6);
    for (std::size_t k = 0; k < records.size(); ++k) EXPECT_EQ(records[k].iteration, k);
    EXPECT_EQ(f.sink.steps[16].iterations.back().attempt, 1u);
  }
}

TEST(Retry, AFailureThatStaysEndsTheRunAndNamesItself) {
  const CoupledModel model = testing::coupledModel(kAllFree, 30);
  Federation f(model, with(Relaxation::kAddedMass), monarchAir(1.0));
  f.fluid->change = [](Reply& reply) {
    if (reply.key.step == 15) reply.error = "the air broke";
  };
  const CoupledOutcome outcome = f.run();
  EXPECT_FALSE(outcome.complete);
  for (const char* words : {"step 15", "two attempts", "a solver failed: the air broke", "ratio"}) {
    EXPECT_NE(outcome.failure.find(words), std::string::npos) << outcome.failure;
  }
  EXPECT_EQ(f.sink.steps.back().step, 14u);
}

TEST(Retry, ALostParticipantIsNotAskedAgain) {
  const CoupledModel model = testing::coupledModel(kAllFree, 30);
  Federation f(model, with(Relaxation::kAddedMass), monarchAir(1.0));
  f.flight->change = [](Reply& reply) {
    if (reply.key.step == 15) throw ExchangeError("flight did not answer");
  };
  EXPECT_EQ(f.run().failure, "flight did not answer");
  EXPECT_EQ(std::count_if(f.flight->requests.begin(), f.flight->requests.end(),
                          [](const Request& r) {
                            return r.key.step == 15 && r.key.phase == Phase::kIterate;
                          }),
            1);
}

/// A step asked a hundred times, other guesses in between, and a run made a hundred times.
TEST(Repetition, AStepIsTheSameStepAHundredTimes) {
  const CoupledModel model = testing::coupledModel(kAllFree, 12);
  Federation first(model, with(Relaxation::kAddedMass), monarchAir(2.0));
  ASSERT_TRUE(first.run().complete);
  for (int i = 0; i < 100; ++i) {
    Federation again(model, with(Relaxation::kAddedMass), monarchAir(2.0));
    ASSERT_TRUE(again.run().complete);
    ASSERT_TRUE(same(first.sink.steps.back().interface, again.sink.steps.back().interface));
    for (Side side : kSides) {
      ASSERT_EQ(first.sink.steps.back().loads[side].moment(),
                again.sink.steps.back().loads[side].moment());
    }
  }
}

TEST(Balance, WorkOfTheAirIsTheSameOnBothSides) {
  const CoupledModel model = testing::coupledModel(kAllFree, kSteps);
  Federation f(model, with(Relaxation::kAddedMass), monarchAir(2.0));
  ASSERT_TRUE(f.run().complete);
  double total = 0.0;
  for (const CommittedStep& step : f.sink.steps) {
    if (step.prescribed) continue;
    const WingMotion motion =
        wingMotion(Side::kRight, model.insect, step.interface.body, step.angles);
    const Loads& loads = step.loads.right;
    const double work =
        model.newmark.dt * (loads.force().dot(motion.v_W) + loads.moment().dot(motion.omega_W));
    EXPECT_NEAR(step.work_fluid, work, 1e-12 * std::abs(work));
    EXPECT_NEAR(step.work_structure, step.work_fluid, 1e-6 * std::abs(work) + 1e-15);
    total += std::abs(work);
  }
  EXPECT_GT(total, 1e-6);
}

TEST(Balance, AMotionThatTheStructureDoesNotShareShowsInTheWork) {
  const CoupledModel model = testing::coupledModel(kAllFree, 1);
  const InterfaceBalance balance(model);
  const PrescribedState prescribed = testing::SineFlapping().at(0.03);
  const Interface seen = prescribed.interface();
  Interface answered = seen;
  for (Side side : kSides) answered.theta[side].qd += 2.0;
  Loads loads;
  loads.moment_pressure = Eigen::Vector3d(0.0, 3e-5, 0.0);
  const InterfacePower power = balance.power(prescribed, seen, answered, both(loads));
  EXPECT_NEAR(power.structure - power.fluid, 6e-5, 1e-12);
}

TEST(Balance, RatioOfOneHingeIsThatOfItsTwoInertias) {
  CoupledModel model = testing::coupledModel({kThetaR}, 1);
  const InterfaceBalance balance(model);
  const PrescribedState prescribed = testing::SineFlapping().at(0.03);
  const Interface level = prescribed.interface();
  Matrix6d M = Matrix6d::Zero();
  M(4, 4) = 5.0 * model.insect.wings.right.plate.J(1, 1);
  EXPECT_NEAR(balance.addedMassRatio(prescribed, level, both(M)), 5.0, 1e-12);
  model.free = {};
  EXPECT_EQ(InterfaceBalance(model).addedMassRatio(prescribed, level, both(M)), 0.0);
  // Whole insect, falling: the air that both wings carry along over the mass of everything.
  model.free = {kZ};
  M = Matrix6d::Identity();
  const double mass =
      MultibodyDynamics(model.insect, 9.81)
          .inertia(insectMotion(model.insect.beta, level.body, prescribed.angles))(2, 2);
  EXPECT_NEAR(InterfaceBalance(model).addedMassRatio(prescribed, level, both(M)), 2.0 / mass,
              1e-9 / mass);
}

TEST(StepModel, IsTheParticipantsOwnAnswer) {
  const CoupledModel model = testing::coupledModel(kAllFree, 30);
  Federation f(model, with(Relaxation::kAitken), monarchAir(1.0));
  ASSERT_TRUE(f.run().complete);
  StepModel copy(model, f.settings.length_scale);
  const CommittedStep& before = f.sink.steps[24];
  copy.begin(before.interface, f.sink.steps[25].guided, 25);
  const CommittedStep& step = f.sink.steps[25];
  const CouplingVector d = copy.increments(step.interface);
  EXPECT_LT(distance(copy.interface(d), step.interface), 1e-15);
  const CouplingVector residual = copy.residual(d, step.loads);
  for (std::size_t i = 0; i < kCoordinates; ++i) {
    EXPECT_NEAR(residual(static_cast<Eigen::Index>(i)), step.iterations.back().residual[i], 1e-15);
  }
}

}  // namespace
}  // namespace monarch_flight
