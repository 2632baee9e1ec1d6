// Checkpoints of a coupled run, and what the coordinator takes up from them.
#include "monarch_flight/coupling/coordinator.h"

namespace monarch_flight {

/// What one step leaves to the next. An accelerator of another kind begins without a memory.
void Coordinator::memory(StateVisitor& state) {
  state("committed", committed_);
  state("prescribed", prescribed_);
  state("loads", loads_.right);
  state("loads_left", loads_.left);
  state("increments_n", history_[0]);
  state("increments_n_minus_1", history_[1]);
  state("increments_n_minus_2", history_[2]);
  state("levels", levels_);
  for (Side side : kSides) {
    const bool right = side == Side::kRight;
    state(right ? "force_scale" : "force_scale_left", force_scale_[side]);
    state(right ? "moment_scale" : "moment_scale_left", moment_scale_[side]);
  }
  state("increment_scales", increment_scales_);
  Relaxation kind = settings_.relaxation;
  state("relaxation", kind);
  if (kind == settings_.relaxation) accelerator_->memory(state);
}

void Coordinator::askAll(const Request& request) {
  for (Role role : kAllRoles) {
    if (participants_[static_cast<std::size_t>(role)] != nullptr) exchange(role, request);
  }
}

void Coordinator::keep(std::uint32_t step) {
  keeper_->open(step);
  Request request;
  request.key = keyOf(step, 0, Phase::kCheckpoint);
  try {
    askAll(request);
  } catch (const NumericalError& e) {  // no reason to try the step once more
    throw ExchangeError(e.what());
  }
  keeper_->close(step, [this](StateVisitor& state) {
    memory(state);
    for (StepSink* sink : sinks_) sink->onCheckpoint(state);
  });
}

/// In the middle of a step: the solvers still stand at the last committed one, and `before_` holds
/// what the coordinator knew then.
void Coordinator::keepBeforeStep(std::uint32_t step) {
  if (!keeper_ || keeper_->settled(step - 1)) return;
  const auto show = [this](StateVisitor& state) { memory(state); };
  StateSnapshot now;
  now.take(show);
  before_.putBack(show);
  keep(step - 1);
  now.putBack(show);
}

/// Takes up the state of the keeper's step; the run has been started.
void Coordinator::resume() {
  Request request;
  request.key = keyOf(*keeper_->resumed(), 0, Phase::kRestore);
  askAll(request);
  keeper_->load([this](StateVisitor& state) { memory(state); });
}

/// Keeps the last committed step of a run that ends before its time; says what came of it.
std::string Coordinator::rescue(std::uint32_t step) {
  if (!keeper_) return "";
  try {
    keepBeforeStep(step + 1);
    return "";
  } catch (const std::exception& e) {
    return "; no checkpoint of it: " + std::string(e.what());
  }
}

}  // namespace monarch_flight
