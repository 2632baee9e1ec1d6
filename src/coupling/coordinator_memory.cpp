// Checkpoints of a coupled run, and what the coordinator takes up from them.
#include "monarch_flight/coupling/coordinator.h"

namespace monarch_flight {
namespace {

constexpr Role kRoles[] = {Role::kFluid, Role::kFlight, Role::kWing};

}  // namespace

/// What one step leaves to the next. An accelerator of another kind begins without a memory.
void Coordinator::memory(StateVisitor& state) {
  state("committed", committed_);
  state("increments_n", history_[0]);
  state("increments_n_minus_1", history_[1]);
  state("increments_n_minus_2", history_[2]);
  state("levels", levels_);
  state("force_scale", force_scale_);
  state("moment_scale", moment_scale_);
  state("increment_scales", increment_scales_);
  Relaxation kind = settings_.relaxation;
  state("relaxation", kind);
  if (kind == settings_.relaxation) accelerator_->memory(state);
}

void Coordinator::keep(std::uint32_t step, const std::vector<StepSink*>& sinks, Keeper& keeper) {
  keeper.open(step);
  CommittedStep unused;
  Request request;
  request.key = {run_id_, step, 0, Phase::kCheckpoint};
  for (Role role : kRoles) ask(role, request, unused);
  keeper.close(step, [&](StateVisitor& state) {
    memory(state);
    for (StepSink* sink : sinks) sink->onCheckpoint(state);
  });
}

void Coordinator::resume(Keeper& keeper) {
  CommittedStep unused;
  Request request;
  request.key = {run_id_, *keeper.resumed(), 0, Phase::kRestore};
  for (Role role : kRoles) ask(role, request, unused);
  keeper.load([this](StateVisitor& state) { memory(state); });
}

/// Keeps the last committed step of a run that ends before its time; says what came of it.
std::string Coordinator::rescue(std::uint32_t step, const std::vector<StepSink*>& sinks,
                                Keeper* keeper) {
  if (!keeper || keeper->settled(step)) return "";
  try {
    before_.putBack([this](StateVisitor& state) { memory(state); });
    keep(step, sinks, *keeper);
    return "; checkpoint of step " + std::to_string(step) + " made";
  } catch (const std::exception& e) {
    return "; no checkpoint of step " + std::to_string(step) + ": " + e.what();
  }
}

}  // namespace monarch_flight
