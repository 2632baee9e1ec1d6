// The order of a coupled run, step by step, and how it ends.
#include <gtest/gtest.h>

#include <limits>

#include "core/coupling_fakes.h"
#include "monarch_flight/coupling/coordinator.h"
#include "monarch_flight/coupling/interface_values.h"

namespace monarch_flight {
namespace {

using testing::dimensionlessDistance;
using testing::Federation;
using testing::monarchAir;

const FreeCoordinates kAllFree = {kX, kZ, kPitch, kThetaR};

class Coordination : public ::testing::Test {
 protected:
  Coordination()
      : f_(testing::coupledModel(kAllFree, 30), testing::couplingSettings(), monarchAir(1.0)) {}
  /// A federation like the usual one with other settings.
  Federation with(const CouplingSettings& settings, double ratio = 1.0) const {
    return Federation(f_.model, settings, monarchAir(ratio));
  }
  Federation f_;
};

TEST_F(Coordination, ConvergedStepsMeetEveryTolerance) {
  ASSERT_TRUE(f_.run().complete);
  for (const CommittedStep& step : f_.sink.steps) {
    EXPECT_FALSE(step.retried());
    EXPECT_EQ(step.prescribed, step.step <= 10);
    if (step.prescribed) continue;
    ASSERT_GE(step.iterations.size(), 2u);
    for (std::size_t k = 0; k < step.iterations.size(); ++k) {
      const IterationRecord& record = step.iterations[k];
      EXPECT_EQ(record.step, step.step);
      EXPECT_EQ(record.iteration, k);
      double largest = 0.0;
      for (double r : record.residual) largest = std::max(largest, std::abs(r));
      const bool converged =
          largest <= f_.settings.tolerance && record.load_residual <= f_.settings.load_tolerance;
      EXPECT_EQ(converged, k + 1 == step.iterations.size());
      EXPECT_EQ(record.relaxation == 0.0, converged);
    }
  }
}

TEST_F(Coordination, CommitsTheInterfaceOfTheLastLoads) {
  ASSERT_TRUE(f_.run().complete);
  std::size_t committed = 0;
  for (const testing::Recorder* p : {f_.fluid.get(), f_.flight.get(), f_.wing.get()}) {
    const Request* last = nullptr;
    for (const Request& r : p->requests) {
      if (r.key.phase == Phase::kIterate) last = &r;
      if (r.key.phase != Phase::kCommit) continue;
      const CommittedStep& step = f_.sink.steps[r.key.step];
      EXPECT_EQ(r.key.iteration, last->key.iteration);
      EXPECT_TRUE(same(r.interface, step.interface));
      for (Side side : kSides)
        EXPECT_TRUE(same(last->interface.theta[side], step.interface.theta[side]));
      EXPECT_TRUE(p == f_.wing.get() || same(last->interface, step.interface));
      for (Side side : kSides) {
        EXPECT_TRUE(p == f_.fluid.get() || last->loads[side].moment() == step.loads[side].moment());
      }
      ++committed;
    }
  }
  EXPECT_EQ(committed, 3u * 30u);
}

TEST_F(Coordination, RunsAreRepeatableBitForBit) {
  Federation again = with(f_.settings);
  ASSERT_TRUE(f_.run().complete);
  ASSERT_TRUE(again.run().complete);
  for (std::size_t i = 0; i < f_.sink.steps.size(); ++i) {
    EXPECT_TRUE(same(f_.sink.steps[i].interface, again.sink.steps[i].interface));
    for (Side side : kSides) {
      EXPECT_EQ(f_.sink.steps[i].loads[side].force(), again.sink.steps[i].loads[side].force());
    }
  }
}

TEST_F(Coordination, PrescribedStartTakesOneEvaluationAStep) {
  ASSERT_TRUE(f_.run().complete);
  EXPECT_TRUE(same(f_.sink.steps[0].interface, f_.prescribed(f_.model.t_start)));
  for (std::uint32_t i = 1; i <= 10; ++i) {
    const CommittedStep& step = f_.sink.steps[i];
    EXPECT_EQ(step.iterations.size(), 1u);
    EXPECT_TRUE(same(step.interface, f_.prescribed(step.t)));
    EXPECT_GT(step.loads.right.force().norm(), 0.0);
  }
  EXPECT_GT(f_.sink.steps[11].iterations.size(), 1u);
}

TEST_F(Coordination, NothingFreeFollowsTheMotion) {
  f_.model.free = {};
  Federation tethered(f_.model, f_.settings, monarchAir(1.0));
  ASSERT_TRUE(tethered.run().complete);
  EXPECT_EQ(tethered.air->evaluations, 30);
  for (const CommittedStep& step : tethered.sink.steps) {
    EXPECT_TRUE(step.prescribed);
    EXPECT_TRUE(same(step.interface, f_.prescribed(step.t)));
    EXPECT_DOUBLE_EQ(step.t, f_.model.time(step.step));
  }
}

TEST_F(Coordination, OnlyWhatIsFreeMoves) {
  f_.model.free = {kZ, kThetaR};
  Federation partly(f_.model, f_.settings, monarchAir(1.0));
  ASSERT_TRUE(partly.run().complete);
  const CommittedStep& last = partly.sink.steps.back();
  const Interface prescribed = f_.prescribed(last.t);
  EXPECT_EQ(last.interface.body.x.x(), prescribed.body.x.x());
  EXPECT_EQ(last.interface.body.R_IB(), prescribed.body.R_IB());
  EXPECT_NE(last.interface.body.x.z(), prescribed.body.x.z());
  EXPECT_NE(last.interface.theta.right.q, prescribed.theta.right.q);
  for (const IterationRecord& record : last.iterations) {
    EXPECT_EQ(record.residual[kX], 0.0);
    EXPECT_EQ(record.residual[kPitch], 0.0);
  }
}

TEST_F(Coordination, ForceIsThatOfBothWingsInInertialAxes) {
  ASSERT_TRUE(f_.run().complete);
  const CommittedStep& step = f_.sink.steps.back();
  const Eigen::Matrix3d R_IB = step.interface.body.R_IB();
  const Eigen::Vector3d right =
      wingAttitude(Side::kRight, f_.model.insect.beta, step.angles.wings.right) *
      step.loads.right.force();
  const Eigen::Vector3d both = R_IB * Eigen::Vector3d(2.0 * right.x(), 0.0, 2.0 * right.z());
  EXPECT_LT((step.force_I - both).norm(), 1e-14 * both.norm());
  for (Side side : kSides) EXPECT_EQ(step.angles.wings[side].theta.q, step.interface.theta[side].q);
}

TEST_F(Coordination, StepsComeInOrderAndTheEndOnce) {
  f_.settings.pictures.surface_every = 5;
  f_.settings.pictures.flow_every = 10;
  f_.settings.pictures.flow_points = 8;
  Federation f(f_.model, f_.settings, monarchAir(1.0));
  ASSERT_TRUE(f.run().complete);
  EXPECT_EQ(f.sink.ends, 1);
  EXPECT_EQ(f.sink.failure, "");
  ASSERT_EQ(f.sink.steps.size(), 31u);
  EXPECT_EQ(f.sink.steps[0].fluid.cells, 42);
  for (std::uint32_t i = 0; i <= 30; ++i) {
    const CommittedStep& step = f.sink.steps[i];
    EXPECT_EQ(step.step, i);
    for (Side side : kSides) {
      EXPECT_EQ(step.surface[side].facets.size(), i > 0 && i % 5 == 0 ? 1u : 0u);
      EXPECT_EQ(step.picture[side].points(), i > 0 && i % 10 == 0 ? 8u : 0u);
    }
  }
  for (const testing::Recorder* p : {f.fluid.get(), f.flight.get(), f.wing.get()}) {
    EXPECT_EQ(p->count(Phase::kStart), 1);
    EXPECT_EQ(p->count(Phase::kCommit), 30);
    EXPECT_EQ(p->count(Phase::kAbort), 1);
  }
}

TEST_F(Coordination, ADivergingStepIsRetriedWithSmallerRelaxation) {
  CouplingSettings settings = f_.settings;
  settings.relaxation = Relaxation::kConstant;
  settings.omega_initial = 1.0;  // diverges; a quarter of it converges
  settings.max_sub_iterations = 200;
  Federation f = with(settings, 8.0);
  const CoupledOutcome outcome = f.run();
  ASSERT_TRUE(outcome.complete) << outcome.failure;
  Federation reference = with(f_.settings, 8.0);
  ASSERT_TRUE(reference.run().complete);
  EXPECT_LT(dimensionlessDistance(f.sink.steps.back().interface,
                                  reference.sink.steps.back().interface, settings.length_scale),
            1e-7);
  const auto& records = f.sink.steps.back().iterations;
  EXPECT_EQ(records.front().relaxation, 1.0);
  EXPECT_EQ(records.front().attempt, 1u);
  EXPECT_EQ(records[records.size() - 2].relaxation, 0.25);
  EXPECT_EQ(records.back().attempt, 2u);
  EXPECT_TRUE(f.sink.steps.back().retried());
}

TEST_F(Coordination, AnUnconvergedStepEndsTheRunWithADiagnosis) {
  CouplingSettings settings = f_.settings;
  settings.relaxation = Relaxation::kAitken;
  settings.max_sub_iterations = 3;
  Federation f = with(settings);
  const CoupledOutcome outcome = f.run();
  EXPECT_FALSE(outcome.complete);
  for (const char* words :
       {"step 11", "did not converge in 6 sub-iterations", "theta_R", "(too large)",
        "added-mass ratio", "relaxation to added_mass", "coupling/max_sub_iterations"}) {
    EXPECT_NE(outcome.failure.find(words), std::string::npos) << outcome.failure;
  }
  EXPECT_EQ(f.sink.failure, outcome.failure);
  EXPECT_EQ(f.sink.ends, 1);
  EXPECT_EQ(f.sink.steps.back().step, 10u);  // nothing unconverged is delivered ...
  EXPECT_EQ(f.air->commits, 10);             // ... or committed
  EXPECT_EQ(f.air->evaluations, 16);
  EXPECT_EQ(f.wing->count(Phase::kAbort), 1);
}

TEST_F(Coordination, AnOrientationThatIsNoAttitudeEndsTheRun) {
  f_.flight->change = [](Reply& reply) {
    if (reply.key.step == 4) reply.interface.body.q_IB.coeffs().setZero();  // forgotten
  };
  const CoupledOutcome outcome = f_.run();
  EXPECT_FALSE(outcome.complete);
  EXPECT_EQ(outcome.failure,
            "flight, step 4, iteration 0, ITERATE: the orientation in the answer is not a unit "
            "quaternion");
}

TEST_F(Coordination, NonFiniteAnswersEndTheRunWithTheirPlace) {
  f_.wing->change = [](Reply& reply) {
    if (reply.key.step == 4)
      reply.interface.theta.right.q = std::numeric_limits<double>::quiet_NaN();
  };
  const CoupledOutcome outcome = f_.run();
  EXPECT_FALSE(outcome.complete);
  EXPECT_EQ(outcome.failure, "wing, step 4, iteration 0, ITERATE: non-finite number in the answer");
  EXPECT_EQ(f_.sink.steps.size(), 4u);
}

TEST_F(Coordination, FailuresOfAParticipantEndTheRun) {
  f_.air->fail = [](int n) {
    if (n == 3) throw NumericalError("the air broke");
  };
  EXPECT_EQ(f_.run().failure, "fluid, step 3, iteration 0, ITERATE: the air broke");

  Federation silent = with(f_.settings);
  silent.flight->change = [](Reply& reply) {
    if (reply.key.step == 2) throw ExchangeError("flight did not answer");
  };
  EXPECT_EQ(silent.run().failure, "flight did not answer");
  EXPECT_EQ(silent.sink.ends, 1);

  Federation confused = with(f_.settings);
  confused.fluid->change = [](Reply& reply) { reply.key.iteration += reply.key.step == 2; };
  EXPECT_NE(confused.run().failure.find("belongs to another request"), std::string::npos);
}

TEST_F(Coordination, StopInterruptsBetweenSubIterations) {
  f_.sink.each = [this](const CommittedStep& step) { f_.stop = step.step == 12; };
  const CoupledOutcome outcome = f_.run();
  EXPECT_FALSE(outcome.complete);
  EXPECT_EQ(outcome.failure, "interrupted in step 13; step 12 is the last one committed");
  EXPECT_EQ(f_.sink.steps.back().step, 12u);
  EXPECT_EQ(f_.fluid->count(Phase::kAbort), 1);
}

/// Goes on, but gives one order before one sub-iteration.
class OneOrder : public RunControl {
 public:
  OneOrder(std::uint32_t step, std::uint32_t iteration, Order order)
      : step_(step), iteration_(iteration), order_(order) {}
  Order next(std::uint32_t step, std::uint32_t iteration) override {
    asked.emplace_back(step, iteration);
    if (given || step != step_ || iteration != iteration_) return Order::kGoOn;
    given = true;
    return order_;
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> asked;
  bool given = false;

 private:
  std::uint32_t step_, iteration_;
  Order order_;
};

TEST_F(Coordination, TheControlIsAskedBeforeEverySubIteration) {
  OneOrder control(0, 0, RunControl::Order::kGoOn);
  ASSERT_TRUE(f_.run(control).complete);
  std::size_t n = 0;
  for (const CommittedStep& step : f_.sink.steps) {
    for (const IterationRecord& record : step.iterations) {
      ASSERT_LT(n, control.asked.size());
      EXPECT_EQ(control.asked[n++], std::make_pair(record.step, record.iteration));
    }
  }
  EXPECT_EQ(n, control.asked.size());
}

TEST_F(Coordination, AResetInsideAStepFliesTheSameFlightAgain) {
  Federation undisturbed = with(f_.settings);
  ASSERT_TRUE(undisturbed.run().complete);
  OneOrder control(14, 1, RunControl::Order::kReset);
  ASSERT_TRUE(f_.run(control).complete);
  EXPECT_TRUE(control.given);
  EXPECT_EQ(f_.sink.resets, 1);
  EXPECT_EQ(f_.fluid->count(Phase::kStart), 2);
  ASSERT_EQ(f_.sink.steps.size(), undisturbed.sink.steps.size());
  for (std::size_t n = 0; n < f_.sink.steps.size(); ++n) {
    EXPECT_TRUE(same(f_.sink.steps[n].interface, undisturbed.sink.steps[n].interface)) << n;
    EXPECT_EQ(f_.sink.steps[n].iterations.size(), undisturbed.sink.steps[n].iterations.size());
  }
}

TEST_F(Coordination, AnOperatorThatWasAskedForAndDidNotComeEndsTheRun) {
  f_.settings.relaxation = Relaxation::kAddedMass;
  f_.fluid->change = [](Reply& reply) { reply.jacobian.reset(); };
  EXPECT_NE(f_.run().failure.find("did not answer with its load operator"), std::string::npos);
}

TEST_F(Coordination, AFailingSinkEndsTheRun) {
  f_.sink.each = [](const CommittedStep& step) {
    if (step.step == 5) throw std::runtime_error("no space left on device");
  };
  EXPECT_EQ(f_.run().failure, "no space left on device");
  EXPECT_EQ(f_.sink.ends, 1);
}

TEST_F(Coordination, BadModelAndSettingsAreRefusedTogether) {
  f_.model.newmark.dt = 0.0;
  f_.model.newmark.beta = 0.0;
  f_.settings.tolerance = -1.0;
  try {
    Coordinator(f_.model, f_.settings, f_.participants(), 1);
    FAIL();
  } catch (const InputError& e) {
    const std::string what = e.what();
    for (const char* key : {"time/dt", "newmark/beta", "coupling/tolerance"}) {
      EXPECT_NE(what.find(key), std::string::npos) << what;
    }
  }
}

}  // namespace
}  // namespace monarch_flight
