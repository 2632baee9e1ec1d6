#include "monarch_flight/coupling/coordinator.h"

#include <algorithm>
#include <chrono>
#include <exception>

#include "monarch_flight/coupling/interface_values.h"
#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kDivergence = 1e3;  // growth of the residual at which an attempt is given up
constexpr double kCautious = 0.25;   // relaxation of the second attempt over that of the first

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

}  // namespace

Coordinator::Coordinator(const CoupledModel& model, const CouplingSettings& settings,
                         Participant& fluid, Participant& flight, Participant& wing,
                         std::uint64_t run_id)
    : model_(model),
      settings_(settings),
      participants_{&fluid, &flight, &wing},
      run_id_(run_id),
      free_{model.free.x, model.free.z, model.free.pitch, model.free.wing_pitch} {
  std::vector<std::string> faults = model.problems();
  for (const std::string& fault : settings.problems()) faults.push_back(fault);
  if (!faults.empty()) throw InputError(faults);
  const double unit = 1.0 / (model.newmark.beta * model.newmark.dt * model.newmark.dt);
  scales_ << settings.length_scale * unit, settings.length_scale * unit, unit, unit;
}

CoupledOutcome Coordinator::run(const std::vector<StepSink*>& sinks, const bool& stop) {
  CoupledOutcome outcome;
  std::uint32_t step = 0;
  try {
    start(sinks);
    for (step = 1; step <= model_.steps; ++step) {
      const CommittedStep committed = advance(step, stop);
      for (StepSink* sink : sinks) sink->onStep(committed);
    }
    outcome.complete = true;
  } catch (const Interrupted&) {
    outcome.failure = "interrupted in step " + std::to_string(step) + "; step " +
                      std::to_string(step - 1) + " is the last one committed";
  } catch (const std::exception& e) {
    outcome.failure = e.what();
  }
  abort(std::min(step, model_.steps));
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

void Coordinator::start(const std::vector<StepSink*>& sinks) {
  const auto begin = Clock::now();
  CommittedStep out;
  out.t = model_.time(0);
  out.prescribed = true;
  Request request;
  request.key = {run_id_, 0, 0, Phase::kStart};
  request.t = out.t;
  request.interface = model_.prescribed(out.t);
  for (Role role : {Role::kFluid, Role::kFlight, Role::kWing}) {
    const Reply reply = ask(role, request, out);
    if (role == Role::kFluid) out.fluid = reply.report;
  }
  levels_ = 0;
  force_scale_ = moment_scale_ = 0.0;
  increment_scales_.setZero();
  history_.fill(CouplingVector::Zero());
  out.interface = request.interface;
  finish(Loads(), out);
  out.exchange_s = std::chrono::duration<double>(Clock::now() - begin).count() - out.wall_s[0] -
                   out.wall_s[1] - out.wall_s[2];
  for (StepSink* sink : sinks) sink->onStep(out);
}

CommittedStep Coordinator::advance(std::uint32_t step, const bool& stop) {
  const auto begin = Clock::now();
  CommittedStep out;
  out.step = step;
  out.t = model_.time(step);
  const Interface prescribed = model_.prescribed(out.t);
  out.prescribed = static_cast<int>(step) <= settings_.prescribed_steps || model_.free.count() == 0;

  Evaluation last;
  if (out.prescribed) {
    if (stop) throw Interrupted();
    last = evaluate(prescribed, out);
  } else if (!converge(settings_, prescribed, stop, last, out) &&
             !converge(cautious(settings_), prescribed, stop, last, out)) {
    throw NumericalError(notConverged(out));
  }
  commit(last, out);
  out.exchange_s = std::chrono::duration<double>(Clock::now() - begin).count() - out.wall_s[0] -
                   out.wall_s[1] - out.wall_s[2];
  return out;
}

bool Coordinator::converge(const CouplingSettings& settings, const Interface& prescribed,
                           const bool& stop, Evaluation& last, CommittedStep& out) {
  const std::unique_ptr<Accelerator> accelerator = makeAccelerator(settings);
  // 1. predict
  CouplingVector d = predictedIncrements();
  double first = 0.0;
  Loads previous;
  for (int k = 0; k < settings.max_sub_iterations; ++k) {
    if (stop) throw Interrupted();
    // 2. exchange
    last = evaluate(guess(d, prescribed), out);
    IterationRecord& record = out.iterations.back();
    // 3. residual; the first sub-iteration has no loads to compare with
    const CouplingVector residual = increments(last.answer) - d;
    std::copy_n(residual.data(), 4, record.residual.begin());
    record.load_residual =
        k == 0 ? 1.0 : std::max(loadChange(last.loads, previous), imbalance(residual, d));
    previous = last.loads;
    // 4. converged, hopeless, or better next time
    const double largest = residual.cwiseAbs().maxCoeff();
    if (largest <= settings.tolerance && record.load_residual <= settings.load_tolerance)
      return true;
    if (k == 0) first = std::max(largest, 1.0 / kDivergence);
    if (largest > kDivergence * first) return false;
    record.relaxation = accelerator->advance(d, residual);
  }
  return false;
}

Coordinator::Evaluation Coordinator::evaluate(const Interface& guess, CommittedStep& out) {
  Evaluation evaluation;
  Request& request = evaluation.request;
  request.key = {run_id_, out.step, static_cast<std::uint32_t>(out.iterations.size()),
                 Phase::kIterate};
  request.t = out.t;
  request.interface = guess;

  const Reply air = ask(Role::kFluid, request, out);
  Request with_loads = request;
  with_loads.loads = evaluation.loads = air.loads;
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
    Reply reply = ask(role, request, out);
    if (role != Role::kFluid) continue;
    out.fluid = reply.report;
    if (surface) out.surface = std::move(reply.surface);
    if (vortices) out.vortices = std::move(reply.vortices);
  }
  out.interface = request.interface;
  finish(last.loads, out);
}

void Coordinator::finish(const Loads& loads, CommittedStep& out) {
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
  history_[0] = increments(committed_);
  levels_ = std::min(levels_ + 1, 3);
  updateScales(loads);
}

void Coordinator::abort(std::uint32_t step) noexcept {
  Request request;
  request.key = {run_id_, step, 0, Phase::kAbort};
  for (Participant* participant : participants_) {
    try {
      participant->exchange(request);
    } catch (...) {  // the run is over; who cannot hear it has its own watchdog
    }
  }
}

Reply Coordinator::ask(Role role, const Request& request, CommittedStep& out) {
  const std::size_t index = static_cast<std::size_t>(role);
  Reply reply = participants_[index]->exchange(request);
  out.wall_s[index] += reply.wall_s;
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
