#include "monarch_flight/run/federation.h"

#include <exception>

#include "monarch_flight/coupling/coordinator.h"
#include "monarch_flight/coupling/participants.h"
#include "monarch_flight/fluid/navier_stokes.h"
#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/run/kept_participant.h"
#include "monarch_flight/run/wing_speeds.h"

namespace monarch_flight {
namespace {

// Ends its sinks in order; the failure of one is told to those behind it.
class SinkChain : public StepSink {
 public:
  explicit SinkChain(const std::vector<StepSink*>& sinks) : sinks_(sinks) {}

  void onStep(const CommittedStep& step) override {
    for (StepSink* sink : sinks_) sink->onStep(step);
  }

  void onCheckpoint(StateVisitor& state) override {
    for (StepSink* sink : sinks_) sink->onCheckpoint(state);
  }

  void onReset() override {
    for (StepSink* sink : sinks_) sink->onReset();
  }

  void onEnd(const std::string& failure) override {
    failure_ = failure;
    for (StepSink* sink : sinks_) {
      try {
        sink->onEnd(failure_);
      } catch (const std::exception& e) {
        const std::string what = e.what();
        const bool told = what.find(failure_) != std::string::npos;
        failure_ = told ? what : failure_ + "; " + what;
      }
    }
  }

  const std::string& failure() const { return failure_; }

 private:
  std::vector<StepSink*> sinks_;
  std::string failure_;
};

}  // namespace

std::unique_ptr<FluidModel> makeFluid(const Case& c) {
  if (c.fluid == FluidKind::kQuasiSteady)
    return makeQuasiSteady(c.insect.planform, c.air, c.blade_element);
  return makeNavierStokes(c.insect.planform, c.air, c.grid, c.watchdog_s);
}

CoupledModel makeModel(const Case& c) {
  CoupledModel model{c.insect};
  model.motion = c.motion;
  model.free = c.free;
  model.newmark.dt = c.time.dt;
  model.gravity = c.gravity;
  model.wind_I = c.air.wind_I;
  model.t_start = c.time.t_start;
  model.steps = c.time.steps;
  if (!c.coupling.accelerations_known) {
    model.release = static_cast<std::uint32_t>(c.coupling.prescribed_steps) + 1;
  }
  model.surface_every = c.output.surface_every;
  model.fields_every = c.output.fields_every;
  model.vortices_every = c.output.vortices_every;
  model.q_threshold = vortexThreshold(c);
  return model;
}

std::unique_ptr<Participant> makeParticipant(Role role, const Case& c,
                                             const std::string& checkpoints) {
  const CoupledModel model = makeModel(c);
  std::unique_ptr<SolverParticipant> solver;
  if (role == Role::kFluid) solver = std::make_unique<FluidParticipant>(model, makeFluid(c));
  if (role == Role::kFlight) solver = std::make_unique<FlightParticipant>(model);
  if (role == Role::kWing) solver = std::make_unique<WingParticipant>(model);
  return std::make_unique<KeptParticipant>(role, std::move(solver), checkpoints);
}

RunResult runCase(const Case& c, std::uint64_t run_id, Participant& fluid, Participant& flight,
                  Participant& wing, const std::vector<StepSink*>& sinks, RunControl& control,
                  Keeper* keeper) {
  SinkChain chain(sinks);
  Coordinator coordinator(makeModel(c), c.coupling, fluid, flight, wing, run_id);
  const CoupledOutcome outcome = coordinator.run({&chain}, control, keeper);
  RunResult result;
  result.failure = chain.failure().empty() ? outcome.failure : chain.failure();
  result.complete = outcome.complete && result.failure.empty();
  return result;
}

InProcessFederation::InProcessFederation(const Case& c, const std::string& checkpoints)
    : case_(c) {
  for (Role role : {Role::kFluid, Role::kFlight, Role::kWing})
    participants_[static_cast<std::size_t>(role)] = makeParticipant(role, c, checkpoints);
}

RunResult InProcessFederation::run(std::uint64_t run_id, const std::vector<StepSink*>& sinks,
                                   const StopFlag& stop, Keeper* keeper) {
  FlyUntil control(stop);
  return runCase(case_, run_id, *participants_[0], *participants_[1], *participants_[2], sinks,
                 control, keeper);
}

}  // namespace monarch_flight
