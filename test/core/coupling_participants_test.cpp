#include <gtest/gtest.h>

#include <limits>

#include "core/coupling_fakes.h"
#include "monarch_flight/coupling/interface_values.h"
#include "monarch_flight/coupling/participants.h"

namespace monarch_flight {
namespace {

using testing::Federation;

const FreeCoordinates kAllFree = {kX, kZ, kPitch, kThetaR};
constexpr std::uint64_t kRun = 7;

Request request(const CoupledModel& model, Phase phase, std::uint32_t step,
                std::uint32_t iteration) {
  Request r;
  r.key = {kRun, step, iteration, phase};
  r.t = model.time(step);
  r.prescribed = testing::SineFlapping().at(r.t);
  r.interface = r.prescribed.interface();
  return r;
}

PerWing<Loads> someLoads() {
  return testing::both(
      Loads{{1e-4, 0.0, -5e-3}, {1e-5, 2e-5, 0.0}, {1e-4, 2e-5, 0.0}, {0.0, 0.0, 1e-6}});
}

class SolverParticipants : public ::testing::Test {
 protected:
  SolverParticipants()
      : f_(testing::coupledModel(kAllFree, 10), testing::couplingSettings(),
           testing::monarchAir(1.0)) {}
  Request make(Phase phase, std::uint32_t step, std::uint32_t iteration) const {
    return request(f_.model, phase, step, iteration);
  }
  std::vector<Participant*> all() {
    return {f_.fluid_solver.get(), f_.flight_solver.get(), f_.wing_solver.get()};
  }
  void startAll() {
    for (Participant* p : all()) ASSERT_EQ(p->exchange(make(Phase::kStart, 0, 0)).error, "");
  }
  void expectRefused(Participant& p, const Request& r, const std::string& words) {
    const Reply reply = p.exchange(r);
    EXPECT_NE(reply.error.find(words), std::string::npos) << reply.error;
    EXPECT_EQ(reply.key, r.key);
  }
  Federation f_;
};

TEST_F(SolverParticipants, SameRequestGetsTheSameAnswerBitForBit) {
  startAll();
  for (Participant* p : all()) {
    Request r = make(Phase::kIterate, 1, 0);
    if (p != f_.fluid_solver.get()) r.loads = someLoads();
    const Reply first = p->exchange(r), again = p->exchange(r);
    EXPECT_EQ(first.error, "");
    EXPECT_TRUE(same(first.interface, again.interface));
    EXPECT_EQ(first.loads.force(), again.loads.force());
    EXPECT_EQ(first.wall_s, again.wall_s);  // from the cache
  }
  EXPECT_EQ(f_.air->evaluations, 1);
}

TEST_F(SolverParticipants, IterationsLeaveNoTrace) {
  startAll();
  for (Participant* p : all()) {
    Request r = make(Phase::kIterate, 1, 0), other = make(Phase::kIterate, 1, 1);
    for (Side side : kSides) other.interface.theta[side].qdd += 100.0;
    other.interface.body.a.z() += 3.0;
    if (p != f_.fluid_solver.get()) r.loads = other.loads = someLoads();
    const Reply first = p->exchange(r);
    p->exchange(other);
    r.key.iteration = 2;
    const Reply later = p->exchange(r);
    EXPECT_TRUE(same(first.interface, later.interface));
    EXPECT_EQ(first.loads.force(), later.loads.force());
    EXPECT_EQ(first.loads.moment(), later.loads.moment());
  }
}

TEST_F(SolverParticipants, AnswersAreTheSolversOwn) {
  startAll();
  Request r = make(Phase::kIterate, 1, 0);
  r.loads = someLoads();
  const CoupledModel& m = f_.model;
  const Interface start = f_.prescribed(m.time(0));
  const JointAngles angles = r.prescribed.anglesWith(r.interface.theta);
  const FlightSolver flight(m.insect, m.gravity, m.free, m.newmark);
  const BodyState body =
      flight.step(start.body, r.interface.body, r.interface.body, angles, r.loads);
  const Reply flown = f_.flight_solver->exchange(r);
  EXPECT_TRUE(same(flown.interface, Interface{body, r.interface.theta}));
  const WingPitchSolver wing(Side::kRight, m.insect, m.gravity, m.newmark);
  const Reply turned = f_.wing_solver->exchange(r);
  const Coordinate theta = wing.step(start.theta.right, r.interface.body, angles, r.loads.right);
  for (Side side : kSides) EXPECT_TRUE(same(turned.interface.theta[side], theta));
  EXPECT_TRUE(same(Interface{turned.interface.body, r.interface.theta}, r.interface));
}

TEST_F(SolverParticipants, CommitKeepsTheAnsweredGuess) {
  startAll();
  for (Participant* p : all()) {
    Request r = make(Phase::kIterate, 1, 4);
    ASSERT_EQ(p->exchange(r).error, "");
    r.key.phase = Phase::kCommit;
    EXPECT_EQ(p->exchange(r).error, "");
    EXPECT_EQ(p->exchange(r).error, "");  // repeated: answered again, done once
    EXPECT_EQ(p->exchange(make(Phase::kIterate, 2, 0)).error, "");
    expectRefused(*p, make(Phase::kIterate, 1, 5), "the committed step is 1");
  }
  EXPECT_EQ(f_.air->commits, 1);
}

TEST_F(SolverParticipants, CommitWithoutIterateIsRefused) {
  startAll();
  for (Participant* p : all()) {
    expectRefused(*p, make(Phase::kCommit, 1, 0), "not the ITERATE of this iteration");
  }
  EXPECT_EQ(f_.air->commits, 0);
}

TEST_F(SolverParticipants, CommitOfAnotherIterationOrInterfaceIsRefused) {
  startAll();
  for (Participant* p : all()) {
    ASSERT_EQ(p->exchange(make(Phase::kIterate, 1, 3)).error, "");
    expectRefused(*p, make(Phase::kCommit, 1, 2), "not the ITERATE of this iteration");
    Request other = make(Phase::kCommit, 1, 3);
    other.interface.body.x.x() += 1e-15;
    for (Side side : kSides) other.interface.theta[side].q += 1e-15;
    expectRefused(*p, other, "not the one that was answered");
    // The refusals have changed nothing.
    EXPECT_EQ(p->exchange(make(Phase::kCommit, 1, 3)).error, "");
  }
}

TEST_F(SolverParticipants, WrongKeysAreRefused) {
  for (Participant* p : all()) {
    expectRefused(*p, make(Phase::kIterate, 1, 0), "no run has been started");
    expectRefused(*p, make(Phase::kStart, 1, 0), "starts with step 0");
  }
  startAll();
  for (Participant* p : all()) {
    expectRefused(*p, make(Phase::kIterate, 2, 0), "only step 1 can follow");
    Request foreign = make(Phase::kIterate, 1, 0);
    foreign.key.run = 8;
    expectRefused(*p, foreign, "belongs to run 8, not to run 7");
    foreign.key.phase = Phase::kAbort;
    expectRefused(*p, foreign, "belongs to run 8, not to run 7");
    EXPECT_EQ(p->exchange(make(Phase::kIterate, 1, 0)).error, "");
  }
}

TEST_F(SolverParticipants, AbortEndsTheRunAndStartBeginsAnother) {
  startAll();
  for (Participant* p : all()) {
    EXPECT_EQ(p->exchange(make(Phase::kAbort, 0, 0)).error, "");
    expectRefused(*p, make(Phase::kIterate, 1, 0), "no run has been started");
    Request again = make(Phase::kStart, 0, 0);
    again.key.run = 9;
    EXPECT_EQ(p->exchange(again).error, "");
    Request next = make(Phase::kIterate, 1, 0);
    next.key.run = 9;
    EXPECT_EQ(p->exchange(next).error, "");
  }
}

TEST_F(SolverParticipants, NonFiniteRequestsAreRefusedByName) {
  startAll();
  const char* names[3] = {
      "fluid, step 1, iteration 3, ITERATE: ", "flight, step 1, iteration 3, ITERATE: ",
      "wing, step 1, iteration 3, ITERATE: "};
  for (std::size_t i = 0; i < 3; ++i) {
    for (Side side : kSides) {
      Request r = make(Phase::kIterate, 1, 3);
      r.interface.theta[side].qdd = std::numeric_limits<double>::quiet_NaN();
      expectRefused(*all()[i], r, std::string(names[i]) + "non-finite number in the request");
      r = make(Phase::kIterate, 1, 3);
      r.loads[side].moment_friction.x() = std::numeric_limits<double>::infinity();
      expectRefused(*all()[i], r, "non-finite number in the request");
    }
  }
}

TEST_F(SolverParticipants, FailureOfASolverIsReportedAndNotCommitted) {
  startAll();
  f_.air->fail = [](int n) {
    if (n == 2) throw NumericalError("the air broke");
  };
  Participant& fluid = *f_.fluid_solver;
  ASSERT_EQ(fluid.exchange(make(Phase::kIterate, 1, 0)).error, "");
  Request r = make(Phase::kIterate, 1, 1);
  r.interface.body.a.x() = 1.0;
  expectRefused(fluid, r, "fluid, step 1, iteration 1, ITERATE: the air broke");
  r.key.phase = Phase::kCommit;
  expectRefused(fluid, r, "not the ITERATE");
  r = make(Phase::kIterate, 1, 2);  // the committed state is unharmed
  EXPECT_EQ(fluid.exchange(r).error, "");
}

TEST_F(SolverParticipants, MotionThatDoesNotReachIsReported) {
  auto motion = std::make_shared<testing::SineFlapping>();
  motion->last = f_.model.time(1);
  GuidanceParticipant guidance(f_.model, std::make_unique<MotionGuidance>(motion));
  ASSERT_EQ(guidance.exchange(make(Phase::kStart, 0, 0)).error, "");
  Request r = make(Phase::kIterate, 1, 0);
  r.t = motion->last + 1.0;
  expectRefused(guidance, r, "motion ends at");
}

TEST_F(SolverParticipants, FluidTellsOfItselfAtTheStartAndShowsFieldsOnDemand) {
  auto air = std::make_unique<testing::LinearAir>(testing::monarchAir(1.0));
  FluidParticipant fluid(Side::kRight, f_.model, std::move(air));
  const Reply start = fluid.exchange(make(Phase::kStart, 0, 0));
  EXPECT_EQ(start.report.cells, 42);
  EXPECT_EQ(start.report.added_mass, f_.air->addedMass());
  for (bool wanted : {false, true}) {
    const std::uint32_t step = wanted ? 2 : 1;
    ASSERT_EQ(fluid.exchange(make(Phase::kIterate, step, 0)).error, "");
    Request commit = make(Phase::kCommit, step, 0);
    commit.want_surface = wanted;
    commit.block_points = wanted ? 5 : 0;
    const Reply reply = fluid.exchange(commit);
    EXPECT_EQ(reply.error, "");
    EXPECT_EQ(reply.surface.facets.size(), wanted ? 1u : 0u);
    EXPECT_EQ(reply.picture.points(), wanted ? 5u : 0u);
  }
}

TEST(ParticipantOfAPrescribedWing, NeedsNoInertia) {
  CoupledModel model = testing::coupledModel({}, 5);
  model.insect.bare_wing = true;
  for (Side side : kSides) {
    model.insect.wings[side].plate.m = 0.0;
    model.insect.wings[side].plate.J.setZero();
  }
  WingParticipant wing(model);
  FlightParticipant flight(model);
  for (Participant* p : std::vector<Participant*>{&wing, &flight}) {
    ASSERT_EQ(p->exchange(request(model, Phase::kStart, 0, 0)).error, "");
    const Request r = request(model, Phase::kIterate, 1, 0);
    EXPECT_TRUE(same(p->exchange(r).interface, r.interface));
  }
}

TEST(Names, OfRolesAndPhases) {
  EXPECT_STREQ(roleName(Role::kFluid), "fluid");
  EXPECT_STREQ(roleName(Role::kFlight), "flight");
  EXPECT_STREQ(roleName(Role::kWing), "wing");
  EXPECT_STREQ(roleName(Role::kFluidLeft), "fluid_left");
  EXPECT_STREQ(phaseName(Phase::kStart), "START");
  EXPECT_STREQ(phaseName(Phase::kIterate), "ITERATE");
  EXPECT_STREQ(phaseName(Phase::kCommit), "COMMIT");
  EXPECT_STREQ(phaseName(Phase::kAbort), "ABORT");
}

}  // namespace
}  // namespace monarch_flight
