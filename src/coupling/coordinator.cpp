// How a coupled run begins, goes from step to step, and ends; the step itself:
// coordinator_step.cpp.
#include "monarch_flight/coupling/coordinator.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <numeric>

#include "monarch_flight/coupling/interface_values.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/seconds_since.h"

namespace monarch_flight {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kCautious = 0.25;  // relaxation of the second attempt over that of the first

/// What the coordinator itself took of a step that began at `begin`.
double ownSeconds(Clock::time_point begin, const CommittedStep& step) {
  const auto of = [&step](Role role) { return step.wall_s[static_cast<std::size_t>(role)]; };
  return secondsSince(begin) - step.exchange_s - std::max(of(Role::kFluid), of(Role::kFluidLeft)) -
         of(Role::kFlight) - of(Role::kWing) - of(Role::kGuidance);
}

/// Smaller relaxation for a second attempt at a step.
CouplingSettings cautious(CouplingSettings settings) {
  settings.omega_initial *= kCautious;
  settings.omega_min = std::min(settings.omega_min, settings.omega_initial);
  settings.omega_max = std::max(settings.omega_initial, kCautious * settings.omega_max);
  return settings;
}

/// The model, or InputError with every fault of both.
const CoupledModel& checked(const CoupledModel& model, const CouplingSettings& settings) {
  std::vector<std::string> faults = model.problems();
  for (const std::string& fault : settings.problems()) faults.push_back(fault);
  if (!faults.empty()) throw InputError(faults);
  return model;
}

}  // namespace

Coordinator::Coordinator(const CoupledModel& model, const CouplingSettings& settings,
                         const Participants& participants, std::uint64_t run_id)
    : model_(model),
      settings_(settings),
      participants_(participants),
      run_id_(run_id),
      step_model_(checked(model, settings), settings.length_scale),
      balance_(model),
      accelerator_(makeAccelerator(settings, step_model_)),
      cautious_(makeAccelerator(cautious(settings), step_model_)) {
  for (Role role : kAllRoles) {
    const bool needed = role != Role::kFluidLeft || !model.mirrored;
    const bool present = participants_[static_cast<std::size_t>(role)] != nullptr;
    if (needed != present)
      throw std::invalid_argument(std::string("participants: ") + roleName(role) +
                                  (needed ? " is missing" : " is not for mirrored wings"));
  }
}

CoupledOutcome Coordinator::run(const std::vector<StepSink*>& sinks, RunControl& control,
                                Keeper* keeper) {
  sinks_ = sinks;
  keeper_ = keeper;
  CoupledOutcome outcome;
  std::uint32_t step = 0;  // the last one committed
  try {
    step = start();
    while (step < model_.steps) {
      try {
        const auto begin = Clock::now();
        CommittedStep committed = advance(step + 1, control);
        committed.coupling_s = ownSeconds(begin, committed);
        step = committed.step;
        deliver(committed);
        if (keeper_ && keeper_->due(step, step == model_.steps)) keep(step);
      } catch (const SetBack&) {
        startAgain();
        step = 0;
      }
    }
    outcome.complete = true;
  } catch (const Interrupted&) {
    outcome.failure = "interrupted in step " + std::to_string(step + 1) + "; step " +
                      std::to_string(step) + " is the last one committed" + rescue(step);
  } catch (const StepFailure& e) {
    outcome.failure = e.what() + rescue(step);
  } catch (const std::exception& e) {
    outcome.failure = e.what();
  }
  abort(std::min(step + 1, model_.steps));
  for (StepSink* sink : sinks) {
    try {
      sink->onEnd(outcome.failure);
    } catch (const std::exception& e) {
      outcome.complete = false;
      outcome.failure += (outcome.failure.empty() ? "" : "\n") + std::string(e.what());
    }
  }
  return outcome;
}

/// Returns the step that the run goes on from, 0 for a new one.
std::uint32_t Coordinator::start() {
  const auto begin = Clock::now();
  CommittedStep out;
  out.t = model_.time(0);
  out.prescribed = true;
  Request request;
  request.key = keyOf(0, 0, Phase::kStart);
  request.t = out.t;
  prescribe(request, out);
  request.prescribed = out.guided;
  request.interface = out.guided.interface();
  const PerWing<Reply> air = askAir(request, out);
  ask(Role::kFlight, request, out);
  ask(Role::kWing, request, out);
  added_mass_ = {air.right.report.added_mass, air.left.report.added_mass};
  operator_cost_ = out.fluid.operator_cost;
  accelerator_->forget();
  levels_ = 0;
  force_scale_ = moment_scale_ = {};
  increment_scales_.setZero();
  history_.fill(CouplingVector::Zero());
  if (keeper_ && keeper_->resumed()) {
    resume();
    return *keeper_->resumed();
  }
  out.interface = request.interface;
  finish({}, out);
  out.coupling_s = ownSeconds(begin, out);
  outputs_s_ = 0.0;
  deliver(out);
  return 0;
}

void Coordinator::deliver(CommittedStep& step) {
  const auto begin = Clock::now();
  step.outputs_s = outputs_s_;
  for (StepSink* sink : sinks_) sink->onStep(step);
  outputs_s_ += secondsSince(begin);
}

void Coordinator::startAgain() {
  ++resets_;
  for (StepSink* sink : sinks_) sink->onReset();
  if (keeper_) keeper_->reset();
  start();
}

/// Asks who leads the run before the next sub-iteration of `out`.
void Coordinator::heed(RunControl& control, const CommittedStep& out) {
  while (true) {
    switch (control.next(out.step, static_cast<std::uint32_t>(out.iterations.size()))) {
      case RunControl::Order::kGoOn:
        return;
      case RunControl::Order::kStop:
        throw Interrupted();
      case RunControl::Order::kReset:
        throw SetBack();
      case RunControl::Order::kCheckpoint:
        keepBeforeStep(out.step);
    }
  }
}

void Coordinator::abort(std::uint32_t step) noexcept {
  Request request;
  request.key = keyOf(step, 0, Phase::kAbort);
  for (Participant* participant : participants_) {
    if (participant == nullptr) continue;
    try {
      participant->exchange(request);
    } catch (...) {  // the run is over; who cannot hear it has its own watchdog
    }
  }
}

ExchangeKey Coordinator::keyOf(std::uint32_t step, std::uint32_t iteration, Phase phase) const {
  return {run_id_, step, iteration, phase, resets_};
}

Reply Coordinator::exchange(Role role, const Request& request) {
  return accepted(role, request, participants_[static_cast<std::size_t>(role)]->exchange(request));
}

Reply Coordinator::accepted(Role role, const Request& request, Reply reply) const {
  if (!reply.error.empty()) throw NumericalError(reply.error);
  const std::string place =
      std::string(roleName(role)) + ", step " + std::to_string(request.key.step) + ", iteration " +
      std::to_string(request.key.iteration) + ", " + phaseName(request.key.phase) + ": ";
  if (reply.key != request.key)
    throw ExchangeError(place + "the answer belongs to another request");
  if (!finite(reply)) throw NumericalError(place + "non-finite number in the answer");
  if ((role == Role::kFlight && !isAttitude(reply.interface.body.q_IB)) ||
      (reply.prescribed && !isAttitude(reply.prescribed->body.q_IB)))
    throw NumericalError(place + "the orientation in the answer is not a unit quaternion");
  return reply;
}

Reply Coordinator::ask(Role role, const Request& request, CommittedStep& out) {
  const auto begin = Clock::now();
  Reply reply = exchange(role, request);
  out.wall_s[static_cast<std::size_t>(role)] += reply.wall_s;
  out.exchange_s += secondsSince(begin) - reply.wall_s;
  return reply;
}

/// The air of both wings, at the same time where both are solved; `out` gets what it reports.
PerWing<Reply> Coordinator::askAir(const Request& request, CommittedStep& out) {
  if (model_.mirrored) {
    const Reply right = ask(Role::kFluid, request, out);
    out.fluid = right.report;
    return {right, right};
  }
  const auto begin = Clock::now();
  PerWing<Reply> air;
  Participant& left = *participants_[static_cast<std::size_t>(Role::kFluidLeft)];
  left.ask(request);
  air.right = exchange(Role::kFluid, request);
  air.left = accepted(Role::kFluidLeft, request, left.answer());
  const auto of = [&out](Role role) -> double& {
    return out.wall_s[static_cast<std::size_t>(role)];
  };
  const auto slower = [&of] { return std::max(of(Role::kFluid), of(Role::kFluidLeft)); };
  const double before = slower();
  for (Side side : kSides) of(kFluids[side]) += air[side].wall_s;
  out.exchange_s += secondsSince(begin) - (slower() - before);  // waiting for the slower one, too
  out.fluid = together(air.right.report, air.left.report);
  return air;
}

}  // namespace monarch_flight
