#include "monarch_flight/run/federation.h"

#include <exception>

#include "monarch_flight/coupling/beside_participant.h"
#include "monarch_flight/coupling/coordinator.h"
#include "monarch_flight/coupling/participants.h"
#include "monarch_flight/fluid/navier_stokes.h"
#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/guidance/flight_controller.h"
#include "monarch_flight/guidance/replay_guidance.h"
#include "monarch_flight/run/kept_participant.h"
#include "monarch_flight/run/plugins.h"

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

std::unique_ptr<FluidModel> makeFluid(const Case& c, Side side) {
  const Planform& planform = c.insect.wings[side].planform;
  if (c.fluid == FluidKind::kPlugin) return fluidByPlugin(c, side);
  if (c.fluid == FluidKind::kQuasiSteady) return makeQuasiSteady(planform, c.air, c.blade_element);
  return makeNavierStokes(planform, c.air, c.grid, c.watchdog_s, c.mirrored ? 1 : 2);
}

CoupledModel makeModel(const Case& c) {
  CoupledModel model{c.insect};
  model.mirrored = c.mirrored;
  model.free = c.free;
  model.newmark.dt = c.time.dt;
  model.gravity = c.gravity;
  model.t_start = c.time.t_start;
  model.steps = c.time.steps;
  if (!c.coupling.accelerations_known) {
    model.release = static_cast<std::uint32_t>(c.coupling.prescribed_steps) + 1;
  }
  return model;
}

PictureSettings picturesOf(const Case& c) {
  PictureSettings pictures;
  pictures.surface_every = c.output.surface_every;
  pictures.flow_every = c.output.flow_every;
  pictures.flow_points = c.output.flow_points;
  pictures.fields_every = c.output.fields_every;
  return pictures;
}

std::unique_ptr<Guidance> makeGuidance(const Case& c, std::shared_ptr<CommandInbox> inbox) {
  const GuidanceSettings& g = c.guidance;
  if (g.kind == GuidanceKind::kPlugin) return guidanceByPlugin(c);
  if (g.kind == GuidanceKind::kReplay) return std::make_unique<ReplayGuidance>(c.motion, g.replay);
  if (g.kind == GuidanceKind::kMotion) {
    const double frequency = c.time.period > 0.0 ? 1.0 / c.time.period : 0.0;
    return std::make_unique<MotionGuidance>(c.motion, c.wind, frequency);
  }
  std::unique_ptr<CommandSource> source;
  if (g.controller) source = std::make_unique<FlightController>(*g.controller);
  if (inbox) source = std::make_unique<PostedCommands>(std::move(inbox));
  return std::make_unique<WingbeatGuidance>(c.motion, c.wind, g.wingbeat, c.time.t_start,
                                            std::move(source));
}

std::vector<Role> rolesOf(const Case& c) {
  std::vector<Role> roles;
  for (Role role : kAllRoles) {
    if (role != Role::kFluidLeft || !c.mirrored) roles.push_back(role);
  }
  return roles;
}

std::unique_ptr<Participant> makeParticipant(Role role, const Case& c,
                                             const std::string& checkpoints,
                                             std::shared_ptr<CommandInbox> inbox) {
  const CoupledModel model = makeModel(c);
  std::unique_ptr<SolverParticipant> solver;
  for (Side side : kSides) {
    if (role == kFluids[side])
      solver = std::make_unique<FluidParticipant>(side, model, makeFluid(c, side));
  }
  if (role == Role::kFlight) solver = std::make_unique<FlightParticipant>(model);
  if (role == Role::kWing) solver = std::make_unique<WingParticipant>(model);
  if (role == Role::kGuidance)
    solver = std::make_unique<GuidanceParticipant>(model, makeGuidance(c, std::move(inbox)));
  // Beside a guidance node, which keeps a part of its own.
  const bool beside = role == Role::kGuidance && c.guidance.kind == GuidanceKind::kNode;
  return std::make_unique<KeptParticipant>(beside ? kWingbeatPart : roleName(role),
                                           std::move(solver), checkpoints);
}

RunResult runCase(const Case& c, std::uint64_t run_id, const Participants& participants,
                  const std::vector<StepSink*>& sinks, RunControl& control, Keeper* keeper) {
  SinkChain chain(sinks);
  CouplingSettings settings = c.coupling;
  settings.pictures = picturesOf(c);
  Coordinator coordinator(makeModel(c), settings, participants, run_id);
  const CoupledOutcome outcome = coordinator.run({&chain}, control, keeper);
  RunResult result;
  result.failure = chain.failure().empty() ? outcome.failure : chain.failure();
  result.complete = outcome.complete && result.failure.empty();
  return result;
}

InProcessFederation::InProcessFederation(const Case& c, const std::string& checkpoints) : case_(c) {
  for (Role role : rolesOf(c)) {
    auto& participant = participants_[static_cast<std::size_t>(role)];
    participant = makeParticipant(role, c, checkpoints);
    if (role == Role::kFluidLeft)  // both wings' air at the same time
      participant = std::make_unique<BesideParticipant>(std::move(participant));
  }
}

RunResult InProcessFederation::run(std::uint64_t run_id, const std::vector<StepSink*>& sinks,
                                   const StopFlag& stop, Keeper* keeper) {
  FlyUntil control(stop);
  return runCase(case_, run_id, participants(), sinks, control, keeper);
}

Participants InProcessFederation::participants() {
  Participants all;
  for (std::size_t i = 0; i < kRoles; ++i) all[i] = participants_[i].get();
  return all;
}

}  // namespace monarch_flight
