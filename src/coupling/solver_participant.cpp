#include <chrono>
#include <stdexcept>

#include "monarch_flight/coupling/interface_values.h"
#include "monarch_flight/coupling/participants.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/seconds_since.h"

namespace monarch_flight {
namespace {

/// The request does not fit the participant's state; nothing was computed, nothing has changed.
class Refusal : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

std::string place(Role role, const ExchangeKey& key) {
  return std::string(roleName(role)) + ", step " + std::to_string(key.step) + ", iteration " +
         std::to_string(key.iteration) + ", " + phaseName(key.phase) + ": ";
}

}  // namespace

SolverParticipant::SolverParticipant(Role role, const CoupledModel& model)
    : role_(role), model_(model) {}

Reply SolverParticipant::exchange(const Request& request) {
  if (answered_ && same(request, last_request_)) return last_reply_;
  const auto begin = std::chrono::steady_clock::now();
  Reply reply;
  reply.key = request.key;
  reply.interface = request.interface;
  try {
    if (!finite(request)) throw Refusal("non-finite number in the request");
    answer(request, reply);
    if (!finite(reply)) throw NumericalError("non-finite number in the answer");
    answered_ = true;
    last_request_ = request;
  } catch (const Refusal& e) {
    reply.error = place(role_, request.key) + e.what();  // the last answer stays good
  } catch (const std::exception& e) {
    answered_ = false;  // the solver failed: nothing to commit
    reply.error = place(role_, request.key) + e.what();
  }
  reply.wall_s = secondsSince(begin);
  if (reply.error.empty()) last_reply_ = reply;
  return reply;
}

void SolverParticipant::answer(const Request& request, Reply& reply) {
  switch (request.key.phase) {
    case Phase::kStart:
      return start(request, reply);
    case Phase::kIterate:
      return iterate(request, reply);
    case Phase::kCommit:
      return commit(request, reply);
    case Phase::kAbort:
      return abort(request);
    case Phase::kCheckpoint:
    case Phase::kRestore:
      throw Refusal("this participant keeps no checkpoints");
  }
  throw Refusal("unknown phase");
}

void SolverParticipant::start(const Request& request, Reply& reply) {
  if (request.key.step != 0) throw Refusal("a run starts with step 0");
  running_ = false;
  onStart(request, reply);
  committed_ = request.interface;
  run_ = request.key.run;
  step_ = 0;
  running_ = true;
}

void SolverParticipant::abort(const Request& request) {
  requireRun(request.key);
  running_ = false;
}

void SolverParticipant::requireRun(const ExchangeKey& key) const {
  if (!running_) throw Refusal("no run has been started");
  if (key.run != run_) {
    throw Refusal("belongs to run " + std::to_string(key.run) + ", not to run " +
                  std::to_string(run_));
  }
}

void SolverParticipant::requireNextStep(const Request& request) const {
  requireRun(request.key);
  if (request.key.step != step_ + 1) {
    throw Refusal("the committed step is " + std::to_string(step_) + ", so only step " +
                  std::to_string(step_ + 1) + " can follow");
  }
}

void SolverParticipant::checkpoint(const ExchangeKey& key, StateVisitor& state) {
  requireRun(key);
  if (key.step != step_) {
    throw Refusal("the committed step is " + std::to_string(step_) + ", not " +
                  std::to_string(key.step));
  }
  state("step", step_);
  state("committed", committed_);
  memory(state);
}

void SolverParticipant::restore(const ExchangeKey& key, StateVisitor& state) {
  requireRun(key);
  answered_ = false;
  state("step", step_);
  state("committed", committed_);
  memory(state);
  if (key.step != step_) {
    throw Refusal("the state is of step " + std::to_string(step_) + ", not " +
                  std::to_string(key.step));
  }
}

void SolverParticipant::iterate(const Request& request, Reply& reply) {
  requireNextStep(request);
  onIterate(request, reply);
}

void SolverParticipant::commit(const Request& request, Reply& reply) {
  requireNextStep(request);
  ExchangeKey answered = request.key;
  answered.phase = Phase::kIterate;
  if (!answered_ || last_request_.key != answered) {
    throw Refusal("the last answered request is not the ITERATE of this iteration");
  }
  if (!sameGuess(last_request_.interface, request.interface)) {
    throw Refusal("the interface to commit is not the one that was answered");
  }
  onCommit(request, reply);
  committed_ = request.interface;
  step_ = request.key.step;
}

}  // namespace monarch_flight
