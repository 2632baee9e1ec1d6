#include "monarch_flight/coupling/coordinator.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>

#include "monarch_flight/coupling/interface_values.h"
#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/seconds_since.h"

namespace monarch_flight {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kDivergence = 1e3;  // growth of the residual at which an attempt is given up
constexpr double kCautious = 0.25;   // relaxation of the second attempt over that of the first

/// What the coordinator itself took of a step that began at `begin`.
double ownSeconds(Clock::time_point begin, const CommittedStep& step) {
  return secondsSince(begin) - step.wall_s[0] - step.wall_s[1] - step.wall_s[2] - step.exchange_s;
}

bool due(std::uint32_t step, int every) {
  return every > 0 && step % static_cast<std::uint32_t>(every) == 0;
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
                         Participant& fluid, Participant& flight, Participant& wing,
                         std::uint64_t run_id)
    : model_(model),
      settings_(settings),
      participants_{&fluid, &flight, &wing},
      run_id_(run_id),
      step_model_(checked(model, settings), settings.length_scale),
      balance_(model),
      accelerator_(makeAccelerator(settings, step_model_)),
      cautious_(makeAccelerator(cautious(settings), step_model_)) {}

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
        CommittedStep committed = advance(step + 1, control);
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
  request.interface = model_.prescribed(out.t);
  for (Role role : {Role::kFluid, Role::kFlight, Role::kWing}) {
    const Reply reply = ask(role, request, out);
    if (role == Role::kFluid) out.fluid = reply.report;
  }
  added_mass_ = out.fluid.added_mass;
  operator_cost_ = out.fluid.operator_cost;
  accelerator_->forget();
  levels_ = 0;
  force_scale_ = moment_scale_ = 0.0;
  increment_scales_.setZero();
  history_.fill(CouplingVector::Zero());
  if (keeper_ && keeper_->resumed()) {
    resume();
    return *keeper_->resumed();
  }
  out.interface = request.interface;
  finish(Loads(), out);
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

CommittedStep Coordinator::advance(std::uint32_t step, RunControl& control) {
  const auto begin = Clock::now();
  CommittedStep out;
  out.step = step;
  out.t = model_.time(step);
  out.prescribed = static_cast<int>(step) <= settings_.prescribed_steps || model_.free.count() == 0;
  before_.take([this](StateVisitor& state) { memory(state); });
  step_model_.begin(committed_, step);

  Evaluation last;
  try {
    if (out.prescribed) {
      heed(control, out);
      last = evaluate(step_model_.prescribed(), false, out);
    } else {
      solve(control, last, out);
    }
  } catch (const NumericalError& e) {
    throw StepFailure(e.what());
  }
  commit(last, out);
  out.coupling_s = ownSeconds(begin, out);
  return out;
}

void Coordinator::solve(RunControl& control, Evaluation& last, CommittedStep& out) {
  std::string error;
  if (attempt(*accelerator_, 1, control, last, out, error)) return;
  accelerator_->forget();
  cautious_->forget();
  if (!attempt(*cautious_, 2, control, last, out, error)) {
    throw NumericalError(notConverged(out, error));
  }
}

/// Returns whether it converged; `error` says what a solver complained of. A lost participant ends
/// the run (ExchangeError): asking again would not bring it back.
bool Coordinator::attempt(Accelerator& accelerator, std::uint32_t number, RunControl& control,
                          Evaluation& last, CommittedStep& out, std::string& error) {
  const std::size_t first = out.iterations.size();
  bool converged = false;
  try {
    converged =
        converge(accelerator, number == 1 ? predictedIncrements() : history_[0], control, last, out);
  } catch (const NumericalError& e) {
    error = e.what();
    IterationRecord failed;  // its number is used up: a key never means two requests
    failed.step = out.step;
    failed.iteration = static_cast<std::uint32_t>(out.iterations.size());
    failed.load_residual = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
      if (step_model_.isFree()[i]) failed.residual[i] = failed.load_residual;
    }
    out.iterations.push_back(failed);
  }
  for (std::size_t i = first; i < out.iterations.size(); ++i) out.iterations[i].attempt = number;
  return converged;
}

bool Coordinator::converge(Accelerator& accelerator, CouplingVector d, RunControl& control,
                           Evaluation& last, CommittedStep& out) {
  accelerator.beginStep(out.step);
  double first = 0.0;
  std::optional<Loads> expected;
  for (int k = 0; k < settings_.max_sub_iterations; ++k) {
    heed(control, out);
    last = evaluate(step_model_.interface(d), accelerator.wantsOperator(operator_cost_), out);
    last.trial.d = d;
    judge(expected, last, out);
    IterationRecord& record = out.iterations.back();
    const double largest = last.trial.residual.cwiseAbs().maxCoeff();
    if (largest <= settings_.tolerance && record.load_residual <= settings_.load_tolerance) {
      accelerator.endStep(last.trial);
      return true;
    }
    if (k == 0) first = std::max(largest, 1.0 / kDivergence);
    if (!(largest <= kDivergence * first)) return false;
    const Proposal next = accelerator.advance(last.trial);
    record.relaxation = next.relaxation;
    d = next.d;
    expected = next.loads ? next.loads : last.trial.loads;
    if (!d.allFinite()) return false;
  }
  return false;
}

/// The residual of a sub-iteration, into its record too. The first one has no loads to compare with.
void Coordinator::judge(const std::optional<Loads>& expected, Evaluation& evaluation,
                        CommittedStep& out) {
  Trial& trial = evaluation.trial;
  trial.residual = step_model_.increments(evaluation.answer) - trial.d;
  IterationRecord& record = out.iterations.back();
  std::copy_n(trial.residual.data(), 4, record.residual.begin());
  record.load_residual = expected ? std::max(loadChange(trial.loads, *expected),
                                             imbalance(trial.residual, trial.d))
                                  : 1.0;
}

Coordinator::Evaluation Coordinator::evaluate(const Interface& guess, bool want_operator,
                                              CommittedStep& out) {
  Evaluation evaluation;
  Request& request = evaluation.request;
  request.key =
      keyOf(out.step, static_cast<std::uint32_t>(out.iterations.size()), Phase::kIterate);
  request.t = out.t;
  request.interface = guess;

  Request to_fluid = request;
  to_fluid.want_operator = want_operator;
  const Reply air = ask(Role::kFluid, to_fluid, out);
  if (want_operator && !air.jacobian) {
    throw ExchangeError(
        "the fluid did not answer with its load operator, which coupling/relaxation = added_mass "
        "needs: let it answer, or take iqn_ils");
  }
  out.fluid_evaluations += 1 + (want_operator ? operator_cost_ : 0);
  evaluation.trial.jacobian = air.jacobian;
  Request with_loads = request;
  with_loads.loads = evaluation.trial.loads = air.loads;
  const Reply body = ask(Role::kFlight, with_loads, out);
  with_loads.interface.body = body.interface.body;
  const Reply wing = ask(Role::kWing, with_loads, out);
  evaluation.answer = {body.interface.body, wing.interface.theta_R};

  IterationRecord record;
  record.step = out.step;
  record.iteration = request.key.iteration;
  record.fluid_wall_s = air.wall_s;
  out.iterations.push_back(record);
  return evaluation;
}

void Coordinator::commit(const Evaluation& last, CommittedStep& out) {
  // 5. commit: what the fluid was last evaluated for, on all sides
  Request request = last.request;
  request.key.phase = Phase::kCommit;
  const bool surface = due(out.step, model_.surface_every);
  const bool vortices = due(out.step, model_.vortices_every);
  for (Role role : {Role::kFluid, Role::kFlight, Role::kWing}) {
    request.want_fields = role == Role::kFluid && (surface || vortices);
    request.want_flow = role == Role::kFluid && due(out.step, model_.fields_every);
    Reply reply = ask(role, request, out);
    if (role != Role::kFluid) continue;
    out.fluid = reply.report;
    if (surface) out.surface = std::move(reply.surface);
    out.flow = std::move(reply.flow);
    if (vortices) out.vortices = std::move(reply.vortices);
  }
  out.interface = request.interface;
  finish(last.trial.loads, out);
  balance(last, out);
}

void Coordinator::balance(const Evaluation& last, CommittedStep& out) const {
  const Interface& guess = last.request.interface;
  const InterfacePower power = balance_.power(out.t, guess, last.answer, last.trial.loads);
  out.work_fluid = power.fluid * model_.newmark.dt;
  out.work_structure = power.structure * model_.newmark.dt;
  out.added_mass_ratio = balance_.addedMassRatio(out.t, guess, added_mass_);
}

void Coordinator::finish(const Loads& loads, CommittedStep& out) {
  for (const Participant* participant : participants_) out.ignored += participant->ignored();
  out.loads = loads;
  out.angles = model_.angles(out.t, out.interface.theta_R);
  const double beta = model_.insect.beta;
  Eigen::Vector3d force_B = wingAttitude(beta, out.angles) * loads.force();
  if (!model_.insect.bare_wing) {
    force_B += leftWingAttitude(beta, out.angles) * mirrored(loads).force();
  }
  out.force_I = out.interface.body.R_IB * force_B;

  committed_ = out.interface;
  history_[2] = history_[1];
  history_[1] = history_[0];
  history_[0] = step_model_.increments(committed_);
  levels_ = std::min(levels_ + 1, 3);
  updateScales(loads);
}

void Coordinator::abort(std::uint32_t step) noexcept {
  Request request;
  request.key = keyOf(step, 0, Phase::kAbort);
  for (Participant* participant : participants_) {
    try {
      participant->exchange(request);
    } catch (...) {  // the run is over; who cannot hear it has its own watchdog
    }
  }
}

ExchangeKey Coordinator::keyOf(std::uint32_t step, std::uint32_t iteration, Phase phase) const {
  return {run_id_, step, iteration, phase, resets_};
}

Reply Coordinator::ask(Role role, const Request& request, CommittedStep& out) {
  const std::size_t index = static_cast<std::size_t>(role);
  const auto begin = Clock::now();
  Reply reply = participants_[index]->exchange(request);
  out.wall_s[index] += reply.wall_s;
  out.exchange_s += secondsSince(begin) - reply.wall_s;
  if (!reply.error.empty()) throw NumericalError(reply.error);
  const std::string place =
      std::string(roleName(role)) + ", step " + std::to_string(request.key.step) + ", iteration " +
      std::to_string(request.key.iteration) + ", " + phaseName(request.key.phase) + ": ";
  if (reply.key != request.key)
    throw ExchangeError(place + "the answer belongs to another request");
  if (!finite(reply)) throw NumericalError(place + "non-finite number in the answer");
  return reply;
}

}  // namespace monarch_flight
