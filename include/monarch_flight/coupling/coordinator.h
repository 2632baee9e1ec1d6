#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/coupling/accelerator.h"
#include "monarch_flight/coupling/model.h"
#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/coupling/settings.h"

namespace monarch_flight {

/// How a coupled run ended. `failure` is empty after a complete run.
struct CoupledOutcome {
  bool complete = false;
  std::string failure;
};

/// The implicit coupling of fluid, flight and wing (model.md section 5). One step from level n to n+1:
///  1. predict: extrapolate the accelerations of the free coordinates, advance by Newmark: guess w^0
///  2. exchange: loads for w^k from the fluid, the body's acceleration from the flight, the wing's
///     pitch acceleration from the wing: answer w~^k
///  3. residual: r^k = w~^k - w^k of each free coordinate, dimensionless; and the change of the loads
///  4. converged when every component and the loads are within their tolerances; else accelerate:
///     w^{k+1} from w^k and r^k, and back to 2
///  5. commit: every participant keeps w^k, the interface of the last evaluation of the fluid
///  6. deliver the committed step to the sinks
/// During the prescribed start, and when nothing is free, w^0 is the prescribed motion and is kept.
class Coordinator {
 public:
  /// Participants must outlive the coordinator. Throws InputError with every fault of model and settings.
  Coordinator(const CoupledModel& model, const CouplingSettings& settings, Participant& fluid,
              Participant& flight, Participant& wing, std::uint64_t run_id);

  /// Runs all steps; level 0 is delivered first. `stop` is polled between sub-iterations. Never throws
  /// for a failed run: participants get ABORT, sinks get onEnd(failure), and the outcome says why.
  CoupledOutcome run(const std::vector<StepSink*>& sinks, const bool& stop);

 private:
  struct Evaluation;  // one sub-iteration: guess, answers, residuals

  void start(const std::vector<StepSink*>& sinks);
  CommittedStep advance(std::uint32_t step, const bool& stop);
  bool converge(const CouplingSettings& settings, const Interface& prescribed, const bool& stop,
                CommittedStep& out, Evaluation& last);
  CouplingVector predictedIncrements() const;
  Interface guess(const CouplingVector& increments, const Interface& prescribed) const;
  CouplingVector increments(const Interface& interface) const;
  Evaluation evaluate(std::uint32_t step, std::uint32_t iteration, const Interface& guess,
                      CommittedStep& out);
  double loadResidual(const Loads& loads, const Loads& previous) const;
  void commit(const Evaluation& last, CommittedStep& out);
  void remember(const CommittedStep& committed);
  Reply ask(Role role, const Request& request, CommittedStep& out);
  void abort(std::uint32_t step) noexcept;
  std::string notConverged(const CommittedStep& step) const;

  CoupledModel model_;
  CouplingSettings settings_;
  std::array<Participant*, 3> participants_;
  std::uint64_t run_id_;
  CouplingVector scales_;              // beta dt^2 / L of each free coordinate: acceleration to increment
  Interface committed_;                // level n
  std::deque<CouplingVector> history_;  // increments of the levels n, n-1, n-2
  double force_scale_ = 0.0, moment_scale_ = 0.0;  // running scale of the loads
};

}  // namespace monarch_flight
