// One step of a coupled run: predict, exchange, compare, accelerate, commit.
#include <algorithm>
#include <limits>

#include "monarch_flight/coupling/coordinator.h"
#include "monarch_flight/coupling/interface_values.h"
#include "monarch_flight/flight/multibody_dynamics.h"

namespace monarch_flight {
namespace {

constexpr double kDivergence = 1e3;  // growth of the residual at which an attempt is given up

bool due(std::uint32_t step, int every) {
  return every > 0 && step % static_cast<std::uint32_t>(every) == 0;
}

}  // namespace

CommittedStep Coordinator::advance(std::uint32_t step, RunControl& control) {
  CommittedStep out;
  out.step = step;
  out.t = model_.time(step);
  out.prescribed = static_cast<int>(step) <= settings_.prescribed_steps || model_.free.count() == 0;
  before_.take([this](StateVisitor& state) { memory(state); });
  heed(control, out);  // before guidance is asked: what is commanded meanwhile counts in this step

  Evaluation last;
  try {
    prescribe(out);
    step_model_.begin(committed_, out.guided, step);
    if (out.prescribed) {
      last = evaluate(out.guided.interface(), false, out);
    } else {
      solve(control, last, out);
    }
  } catch (const NumericalError& e) {
    throw StepFailure(e.what());
  }
  commit(last, out);
  return out;
}

// 0. prescribe: guidance hears of all of level n, and says all that is prescribed at level n+1.
void Coordinator::prescribe(CommittedStep& out) {
  Request request;
  request.key = keyOf(out.step, 0, Phase::kIterate);
  request.t = out.t;
  request.prescribed = prescribed_;
  request.interface = committed_;
  request.loads = loads_;
  prescribe(request, out);
}

void Coordinator::prescribe(const Request& request, CommittedStep& out) {
  const Reply reply = ask(Role::kGuidance, request, out);
  if (!reply.prescribed) {
    throw ExchangeError("guidance did not say what is prescribed at step " +
                        std::to_string(request.key.step) + ": let it answer `prescribed`");
  }
  out.guided = *reply.prescribed;
  if (model_.mirrored) {  // whatever was said of the left wing
    out.guided.angles.wings.left = out.guided.angles.wings.right;
    out.guided.rest_angle.left = out.guided.rest_angle.right;
  }
  out.guidance = reply.guidance;
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
    converged = converge(accelerator, number == 1 ? predictedIncrements() : history_[0], control,
                         last, out);
  } catch (const NumericalError& e) {
    error = e.what();
    IterationRecord failed;  // its number is used up: a key never means two requests
    failed.step = out.step;
    failed.iteration = static_cast<std::uint32_t>(out.iterations.size());
    failed.load_residual = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < kCoordinates; ++i) {
      if (model_.free[i]) failed.residual[i] = failed.load_residual;
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
  std::optional<PerWing<Loads>> expected;
  for (int k = 0; k < settings_.max_sub_iterations; ++k) {
    if (!out.iterations.empty()) heed(control, out);
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

/// The residual of a sub-iteration, into its record too. The first one has no loads to compare
/// with.
void Coordinator::judge(const std::optional<PerWing<Loads>>& expected, Evaluation& evaluation,
                        CommittedStep& out) {
  Trial& trial = evaluation.trial;
  trial.residual = step_model_.increments(evaluation.answer) - trial.d;
  IterationRecord& record = out.iterations.back();
  std::copy_n(trial.residual.data(), kCoordinates, record.residual.begin());
  record.load_residual =
      expected ? std::max(loadChange(trial.loads, *expected), imbalance(trial.residual, trial.d))
               : 1.0;
}

Coordinator::Evaluation Coordinator::evaluate(const Interface& guess, bool want_operator,
                                              CommittedStep& out) {
  Evaluation evaluation;
  Request& request = evaluation.request;
  request.key = keyOf(out.step, static_cast<std::uint32_t>(out.iterations.size()), Phase::kIterate);
  request.t = out.t;
  request.prescribed = out.guided;
  request.interface = guess;

  Request to_fluid = request;
  to_fluid.want_operator = want_operator;
  const PerWing<Reply> air = askAir(to_fluid, out);
  if (want_operator && !(air.right.jacobian && air.left.jacobian)) {
    throw ExchangeError(
        "the fluid did not answer with its load operator, which coupling/relaxation = added_mass "
        "needs: let it answer, or set coupling/relaxation to iqn_ils in the case file");
  }
  out.fluid_evaluations += 1 + (want_operator ? operator_cost_ : 0);
  if (want_operator) evaluation.trial.jacobian = {*air.right.jacobian, *air.left.jacobian};
  Request with_loads = request;
  with_loads.loads = evaluation.trial.loads = {air.right.loads, air.left.loads};
  const Reply body = ask(Role::kFlight, with_loads, out);
  with_loads.interface.body = body.interface.body;
  const Reply wing = ask(Role::kWing, with_loads, out);
  evaluation.answer = {body.interface.body, wing.interface.theta};

  IterationRecord record;
  record.step = out.step;
  record.iteration = request.key.iteration;
  record.fluid_wall_s = std::max(air.right.wall_s, air.left.wall_s);
  out.iterations.push_back(record);
  return evaluation;
}

void Coordinator::commit(const Evaluation& last, CommittedStep& out) {
  // 5. commit: what the fluid was last evaluated for, on all sides
  Request request = last.request;
  request.key.phase = Phase::kCommit;
  const PictureSettings& pictures = settings_.pictures;
  Request to_fluid = request;
  to_fluid.want_surface = due(out.step, pictures.surface_every);
  if (due(out.step, pictures.flow_every))
    to_fluid.block_points = static_cast<std::uint32_t>(pictures.flow_points);
  to_fluid.want_flow = due(out.step, pictures.fields_every);
  PerWing<Reply> air = askAir(to_fluid, out);
  for (Side side : kSides) {
    if (to_fluid.want_surface) out.surface[side] = std::move(air[side].surface);
    if (to_fluid.block_points > 0) out.picture[side] = std::move(air[side].picture);
    if (to_fluid.want_flow) out.flow[side] = std::move(air[side].flow);
  }
  ask(Role::kFlight, request, out);
  ask(Role::kWing, request, out);
  request.key.iteration = 0;  // guidance was asked once
  ask(Role::kGuidance, request, out);
  out.interface = request.interface;
  finish(last.trial.loads, out);
  balance(last, out);
}

void Coordinator::balance(const Evaluation& last, CommittedStep& out) const {
  const Interface& guess = last.request.interface;
  const InterfacePower power = balance_.power(out.guided, guess, last.answer, last.trial.loads);
  out.work_fluid = power.fluid * model_.newmark.dt;
  out.work_structure = power.structure * model_.newmark.dt;
  out.added_mass_ratio = balance_.addedMassRatio(out.guided, guess, added_mass_);
}

void Coordinator::finish(const PerWing<Loads>& loads, CommittedStep& out) {
  for (const Participant* participant : participants_) {
    if (participant != nullptr) out.ignored += participant->ignored();
  }
  out.loads = loads;
  out.angles = out.guided.anglesWith(out.interface.theta);
  const double beta = model_.insect.beta;
  const auto& [right, left] = out.angles.wings;
  Eigen::Vector3d force_B = wingAttitude(Side::kRight, beta, right) * loads.right.force();
  if (!model_.insect.bare_wing)
    force_B += wingAttitude(Side::kLeft, beta, left) * mirrored(loads.left).force();
  out.force_I = out.interface.body.R_IB() * force_B;

  committed_ = out.interface;
  prescribed_ = out.guided;
  loads_ = loads;
  history_[2] = history_[1];
  history_[1] = history_[0];
  history_[0] = step_model_.increments(committed_);
  levels_ = std::min(levels_ + 1, 3);
  updateScales(loads);
}

}  // namespace monarch_flight
