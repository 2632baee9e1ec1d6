// Who owns the motion: guidance, asked once a step; solvers get everything by request.
#include <gtest/gtest.h>

#include "core/coupling_fakes.h"
#include "monarch_flight/coupling/interface_values.h"

namespace monarch_flight {
namespace {

using testing::Federation;
using testing::monarchAir;

const FreeCoordinates kAllFree = {kX, kZ, kPitch, kThetaR};

/// Adds to the flapping what it has counted: answers differ from call to call.
class Counting : public Guidance {
 public:
  PrescribedState start(double t) override {
    count = 0.0;
    return motion_.at(t);
  }
  PrescribedState next(const GuidanceInput& input) override {
    ++asked;
    count += 1.0;
    last = input;
    PrescribedState state = motion_.at(input.t);
    for (Side side : kSides) state.angles.wings[side].phi.q += 1e-7 * count;
    return state;
  }
  void memory(StateVisitor& state) override { state("count", count); }
  double count = 0.0;
  int asked = 0;
  GuidanceInput last;

 private:
  testing::SineFlapping motion_;
};

class Guided : public ::testing::Test {
 protected:
  Guided() : f_(testing::coupledModel(kAllFree, 30), testing::couplingSettings(), monarchAir(1.0)) {
    auto owned = std::make_unique<Counting>();
    counting_ = owned.get();
    f_.guidance_solver = std::make_unique<GuidanceParticipant>(f_.model, std::move(owned));
    f_.guidance = std::make_unique<testing::Recorder>(*f_.guidance_solver);
  }
  Federation f_;
  Counting* counting_;
};

TEST_F(Guided, IsAskedOnceAStepAndHearsOfTheCommittedLevel) {
  ASSERT_TRUE(f_.run().complete);
  EXPECT_EQ(counting_->asked, 30);
  const CommittedStep& before = f_.sink.steps[29];
  EXPECT_TRUE(same(counting_->last.interface, before.interface));
  for (Side side : kSides)
    EXPECT_EQ(counting_->last.loads[side].force(), before.loads[side].force());
  EXPECT_EQ(prescribedValues(counting_->last.prescribed), prescribedValues(before.guided));
  EXPECT_EQ(counting_->last.t, f_.model.time(30));
  EXPECT_EQ(f_.guidance->count(Phase::kIterate), 30);
  EXPECT_EQ(f_.guidance->count(Phase::kCommit), 30);
}

TEST_F(Guided, WhatItPrescribesIsInEveryRequest) {
  ASSERT_TRUE(f_.run().complete);
  for (const auto* solver : {f_.fluid.get(), f_.flight.get(), f_.wing.get()}) {
    for (const Request& request : solver->requests) {
      if (request.key.phase == Phase::kAbort) continue;
      const CommittedStep& step = f_.sink.steps[request.key.step];
      ASSERT_EQ(prescribedValues(request.prescribed), prescribedValues(step.guided));
    }
  }
  for (Side side : kSides) {
    EXPECT_NEAR(f_.sink.steps[20].angles.wings[side].phi.q,
                testing::SineFlapping().at(f_.model.time(20)).angles.wings[side].phi.q + 1e-7 * 20,
                1e-15);
  }
}

TEST_F(Guided, IsNotAskedAgainByAStepThatIsTriedAgain) {
  bool failed = false;
  f_.fluid->change = [&failed](Reply& reply) {
    if (failed || reply.key.step != 20 || reply.key.phase != Phase::kIterate) return;
    failed = true;
    reply.error = "the air broke";
  };
  ASSERT_TRUE(f_.run().complete);
  EXPECT_TRUE(f_.sink.steps[20].retried());
  EXPECT_EQ(counting_->asked, 30);
}

/// A checkpoint within a step holds guidance's memory of the committed level, and changes nothing.
TEST_F(Guided, ItsMemoryOfTheCommittedLevelIsShownAlsoWithinAStep) {
  GuidanceParticipant& guidance = static_cast<GuidanceParticipant&>(*f_.guidance_solver);
  const auto ask = [&](Phase phase, std::uint32_t step) {
    Request r;
    r.key = {7, step, 0, phase};
    r.t = f_.model.time(step);
    return guidance.exchange(r);
  };
  const auto kept = [&](std::uint32_t step) {
    StateSnapshot snapshot;
    snapshot.take([&](StateVisitor& s) {
      guidance.checkpoint({7, step, 0, Phase::kCheckpoint}, s);
    });
    return snapshot;
  };
  ask(Phase::kStart, 0);
  ask(Phase::kIterate, 1);
  ask(Phase::kCommit, 1);
  const Reply second = ask(Phase::kIterate, 2);
  StateSnapshot within = kept(1);
  EXPECT_EQ(counting_->count, 2.0);
  EXPECT_EQ(ask(Phase::kCommit, 2).error, "");
  EXPECT_EQ(ask(Phase::kIterate, 3).prescribed->angles.wings.right.phi.q,
            testing::SineFlapping().at(f_.model.time(3)).angles.wings.right.phi.q + 3e-7);
  within.putBack([&](StateVisitor& s) { guidance.restore({7, 1, 0, Phase::kRestore}, s); });
  EXPECT_EQ(counting_->count, 1.0);
  EXPECT_EQ(prescribedValues(*ask(Phase::kIterate, 2).prescribed),
            prescribedValues(*second.prescribed));
}

TEST_F(Guided, ThatSaysNothingEndsTheRun) {
  f_.guidance->change = [](Reply& reply) { reply.prescribed.reset(); };
  EXPECT_NE(f_.run().failure.find("guidance did not say what is prescribed"), std::string::npos);
}

}  // namespace
}  // namespace monarch_flight
