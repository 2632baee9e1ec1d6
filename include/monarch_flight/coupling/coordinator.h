#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "monarch_flight/coupling/accelerator.h"
#include "monarch_flight/coupling/interface_balance.h"
#include "monarch_flight/coupling/keeper.h"
#include "monarch_flight/coupling/model.h"
#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/coupling/run_control.h"
#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/coupling/step_model.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {

/// How a coupled run ended. `failure` is empty after a complete run.
struct CoupledOutcome {
  bool complete = false;
  std::string failure;
};

/// The participants of a run by role, null where there is none; they must outlive it.
using Participants = std::array<Participant*, kRoles>;

/// The implicit coupling of fluid, flight and wing. One step from level n to n+1:
///  0. prescribe: guidance says everything that is prescribed at level n+1, once for all attempts
///  1. predict: extrapolate the accelerations of the free coordinates, advance by Newmark: guess
///  w^0
///  2. exchange: loads for w^k from the fluid (of both wings at the same time), the body's
///     acceleration from the flight, the wings' pitch acceleration from the wing: answer w~^k
///  3. residual: r^k = w~^k - w^k of each free coordinate, dimensionless; imbalance of inertia, and
///     change of the loads against those that the accelerator predicted (else: the last ones),
///     relative to their running scales
///  4. converged when every component and the loads are within their tolerances; else accelerate:
///     w^{k+1} from w^k and r^k, and back to 2
///  A step that diverges, stalls or makes a solver fail is tried once more: from a predictor of
///  lower order, the accelerator's memory empty, with smaller relaxation.
///  5. commit: every participant keeps w^k, the interface of the last evaluation of the fluid
///  6. deliver the committed step to the sinks
/// During the prescribed start, and when nothing is free, w^0 is the prescribed motion and is kept.
class Coordinator {
 public:
  /// Throws InputError with every fault of model and settings.
  Coordinator(const CoupledModel& model, const CouplingSettings& settings,
              const Participants& participants, std::uint64_t run_id);

  /// Runs all steps; level 0 is delivered first. `control` is asked before every sub-iteration.
  /// Never throws for a failed run: participants get ABORT, sinks get onEnd(failure), and the
  /// outcome says why. With a `keeper`, checkpoints are made of the steps that it names, of the
  /// last one, and of the last committed one when the run is stopped or a step fails; a resumed run
  /// goes on after the keeper's step, bit for bit as if it had never ended.
  CoupledOutcome run(const std::vector<StepSink*>& sinks, RunControl& control,
                     Keeper* keeper = nullptr);

 private:
  struct Evaluation {  // one sub-iteration
    Request request;   // to the fluid: the guess w^k
    Trial trial;       // its increments, residual and loads
    Interface answer;  // w~^k
  };
  struct Interrupted {};                       // the control ends the run
  struct SetBack {};                           // the control begins it again
  class StepFailure : public NumericalError {  // no solver has committed the step
   public:
    using NumericalError::NumericalError;
  };

  std::uint32_t start();
  void startAgain();
  void resume();
  void deliver(CommittedStep& step);
  void heed(RunControl& control, const CommittedStep& out);
  void memory(StateVisitor& state);
  void keep(std::uint32_t step);
  void keepBeforeStep(std::uint32_t step);
  std::string rescue(std::uint32_t step);
  ExchangeKey keyOf(std::uint32_t step, std::uint32_t iteration, Phase phase) const;
  CommittedStep advance(std::uint32_t step, RunControl& control);
  void prescribe(CommittedStep& out);
  void prescribe(const Request& request, CommittedStep& out);
  void solve(RunControl& control, Evaluation& last, CommittedStep& out);
  bool attempt(Accelerator& accelerator, std::uint32_t number, RunControl& control,
               Evaluation& last, CommittedStep& out, std::string& error);
  bool converge(Accelerator& accelerator, CouplingVector d, RunControl& control, Evaluation& last,
                CommittedStep& out);
  Evaluation evaluate(const Interface& guess, bool want_operator, CommittedStep& out);
  void judge(const std::optional<PerWing<Loads>>& expected, Evaluation& evaluation,
             CommittedStep& out);
  void commit(const Evaluation& last, CommittedStep& out);
  void balance(const Evaluation& last, CommittedStep& out) const;
  void finish(const PerWing<Loads>& loads, CommittedStep& out);
  void abort(std::uint32_t step) noexcept;
  Reply ask(Role role, const Request& request, CommittedStep& out);
  PerWing<Reply> askAir(const Request& request, CommittedStep& out);
  void askAll(const Request& request);
  Reply exchange(Role role, const Request& request);
  Reply accepted(Role role, const Request& request, Reply reply) const;

  CouplingVector predictedIncrements() const;
  double loadChange(const PerWing<Loads>& loads, const PerWing<Loads>& previous) const;
  double imbalance(const CouplingVector& residual, const CouplingVector& increments) const;
  void updateScales(const PerWing<Loads>& loads);
  std::string notConverged(const CommittedStep& step, const std::string& error) const;
  std::string advice(double ratio) const;

  CoupledModel model_;
  CouplingSettings settings_;
  Participants participants_;
  std::uint64_t run_id_;
  std::uint32_t resets_ = 0;
  std::vector<StepSink*> sinks_;  // of the run
  Keeper* keeper_ = nullptr;      // of the run; none: no checkpoints
  StepModel step_model_;
  InterfaceBalance balance_;
  std::unique_ptr<Accelerator> accelerator_, cautious_;  // of first and of second attempts
  PerWing<Matrix6d> added_mass_;                         // of the fluids, for the ratio
  int operator_cost_ = 0;                                // of a fluid, in evaluations
  Interface committed_;                                  // level n
  PrescribedState prescribed_;                           // level n
  PerWing<Loads> loads_;                                 // level n
  StateSnapshot before_;                   // memory of level n, while a step is solved
  std::array<CouplingVector, 3> history_;  // increments of the levels n, n-1, n-2
  int levels_ = 0;                         // how many of them are known
  double outputs_s_ = 0.0;                 // wall time of the sinks so far
  // Running scales: largest of the recent past, at least what is worth noticing.
  PerWing<double> force_scale_, moment_scale_;
  CouplingVector increment_scales_ = CouplingVector::Zero();
};

}  // namespace monarch_flight
