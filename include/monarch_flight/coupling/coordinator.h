#pragma once
#include <array>
#include <cstdint>
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

/// The implicit coupling of fluid, flight and wing (model.md section 5). One step from level n to
/// n+1:
///  1. predict: extrapolate the accelerations of the free coordinates, advance by Newmark: guess
///  w^0
///  2. exchange: loads for w^k from the fluid, the body's acceleration from the flight, the wing's
///     pitch acceleration from the wing: answer w~^k
///  3. residual: r^k = w~^k - w^k of each free coordinate, dimensionless; change and imbalance
///     of the loads, relative to their running scales
///  4. converged when every component and the loads are within their tolerances; else accelerate:
///     w^{k+1} from w^k and r^k, and back to 2
///  5. commit: every participant keeps w^k, the interface of the last evaluation of the fluid
///  6. deliver the committed step to the sinks
/// During the prescribed start, and when nothing is free, w^0 is the prescribed motion and is kept.
class Coordinator {
 public:
  /// Participants must outlive the coordinator. Throws InputError with every fault of model and
  /// settings.
  Coordinator(const CoupledModel& model, const CouplingSettings& settings, Participant& fluid,
              Participant& flight, Participant& wing, std::uint64_t run_id);

  /// Runs all steps; level 0 is delivered first. `stop` is polled between sub-iterations. Never
  /// throws for a failed run: participants get ABORT, sinks get onEnd(failure), and the outcome
  /// says why.
  CoupledOutcome run(const std::vector<StepSink*>& sinks, const bool& stop);

 private:
  struct Evaluation {  // one sub-iteration
    Request request;   // to the fluid: the guess w^k
    Loads loads;       // for it
    Interface answer;  // w~^k
  };
  struct Interrupted {};  // `stop` was seen

  void start(const std::vector<StepSink*>& sinks);
  CommittedStep advance(std::uint32_t step, const bool& stop);
  bool converge(const CouplingSettings& settings, const Interface& prescribed, const bool& stop,
                Evaluation& last, CommittedStep& out);
  Evaluation evaluate(const Interface& guess, CommittedStep& out);
  void commit(const Evaluation& last, CommittedStep& out);
  void finish(const Loads& loads, CommittedStep& out);
  void abort(std::uint32_t step) noexcept;
  Reply ask(Role role, const Request& request, CommittedStep& out);

  CouplingVector increments(const Interface& interface) const;
  CouplingVector predictedIncrements() const;
  Interface guess(const CouplingVector& increments, const Interface& prescribed) const;
  double loadChange(const Loads& loads, const Loads& previous) const;
  double imbalance(const CouplingVector& residual, const CouplingVector& increments) const;
  void updateScales(const Loads& loads);
  std::string notConverged(const CommittedStep& step) const;

  CoupledModel model_;
  CouplingSettings settings_;
  std::array<Participant*, 3> participants_;
  std::uint64_t run_id_;
  std::array<bool, 4> free_;  // x, z, pitch, wing pitch
  CouplingVector scales_;     // L / (beta dt^2): increment d to acceleration, a = d L / (beta dt^2)
  Interface committed_;       // level n
  std::array<CouplingVector, 3> history_;  // increments of the levels n, n-1, n-2
  int levels_ = 0;                         // how many of them are known
  // Running scales: largest of the recent past, at least what is worth noticing.
  double force_scale_ = 0.0, moment_scale_ = 0.0;
  CouplingVector increment_scales_ = CouplingVector::Zero();
};

}  // namespace monarch_flight
