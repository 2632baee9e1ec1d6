#pragma once
#include <memory>
#include <optional>
#include <string>

#include "monarch_flight/coupling/guidance.h"
#include "monarch_flight/coupling/model.h"
#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/coupling/state_visitor.h"
#include "monarch_flight/flight/flight_solver.h"
#include "monarch_flight/wing/wing_pitch_solver.h"

namespace monarch_flight {

/// What the in-process participants, guidance included, have in common: keys, cache and failures.
///  - START takes the initial state and forgets everything else.
///  - ITERATE of step n+1 is answered from (committed state n, request); the last answer is kept,
///  and
///    the same request again gets the same answer, bit for bit.
///  - COMMIT must carry the key (run, step, iteration) of the last answered ITERATE and its guess,
///  which
///    becomes the committed state. The same COMMIT again gets the same answer.
///  - ABORT ends the run: only START is accepted after it.
///  - CHECKPOINT and RESTORE need a file; whoever has one calls `checkpoint` and `restore`
///    (run/kept_participant.h).
/// Wrong keys, non-finite numbers and exceptions of a solver end in Reply::error, which names
/// participant, step, iteration and phase; the committed state stays as it was.
class SolverParticipant : public Participant {
 public:
  Reply exchange(const Request& request) final;
  /// Shows the committed state. Throws std::invalid_argument when `key` names another run or step.
  void checkpoint(const ExchangeKey& key, StateVisitor& state);
  /// Takes up the state of step key.step; the run must have been started. The same exceptions.
  void restore(const ExchangeKey& key, StateVisitor& state);

 protected:
  SolverParticipant(Role role, const CoupledModel& model);
  const CoupledModel& model() const { return model_; }
  /// Level n.
  const Interface& committed() const { return committed_; }

 private:
  virtual void onStart(const Request& request, Reply& reply) = 0;
  virtual void onIterate(const Request& request, Reply& reply) = 0;
  /// The answered guess is about to become the committed state.
  virtual void onCommit(const Request& request, Reply& reply) = 0;
  /// What the solver itself carries from step to step.
  virtual void memory(StateVisitor&) {}
  /// Whether `committed` is the part of the guess that the participant answered for.
  virtual bool sameGuess(const Interface& answered, const Interface& committed) const = 0;

  void answer(const Request& request, Reply& reply);
  void start(const Request& request, Reply& reply);
  void iterate(const Request& request, Reply& reply);
  void commit(const Request& request, Reply& reply);
  void abort(const Request& request);
  void requireRun(const ExchangeKey& key) const;
  void requireNextStep(const Request& request) const;

  Role role_;
  CoupledModel model_;
  Interface committed_;
  std::uint64_t run_ = 0;
  std::uint32_t step_ = 0;  // committed time level
  bool running_ = false;
  bool answered_ = false;  // last_reply_ is the answer to last_request_
  Request last_request_;
  Reply last_reply_;
};

/// The air: loads on its wing for the guessed interface. The left wing flies in a mirror, so that
/// it is a right wing for the flow (state.h).
class FluidParticipant : public SolverParticipant {
 public:
  FluidParticipant(Side side, const CoupledModel& model, std::unique_ptr<FluidModel> fluid);
  const FluidModel& fluid() const { return *fluid_; }

 private:
  void onStart(const Request& request, Reply& reply) override;
  void onIterate(const Request& request, Reply& reply) override;
  void onCommit(const Request& request, Reply& reply) override;
  void memory(StateVisitor& state) override;
  bool sameGuess(const Interface& answered, const Interface& committed) const override;
  WingMotion motion(const Request& request) const;

  Side side_;
  std::unique_ptr<FluidModel> fluid_;
};

/// The body: its state for the given loads and the guess of body and wing.
class FlightParticipant : public SolverParticipant {
 public:
  explicit FlightParticipant(const CoupledModel& model);

 private:
  void onStart(const Request& request, Reply& reply) override;
  void onIterate(const Request& request, Reply& reply) override;
  void onCommit(const Request& request, Reply& reply) override;
  bool sameGuess(const Interface& answered, const Interface& committed) const override;

  FlightSolver solver_;
};

/// The hinges: the wings' pitch for the given loads, the body's answer and the guess of the pitch.
class WingParticipant : public SolverParticipant {
 public:
  explicit WingParticipant(const CoupledModel& model);

 private:
  void onStart(const Request& request, Reply& reply) override;
  void onIterate(const Request& request, Reply& reply) override;
  void onCommit(const Request& request, Reply& reply) override;
  bool sameGuess(const Interface& answered, const Interface& committed) const override;

  PerWing<std::optional<WingPitchSolver>> solvers_;  // empty when the pitch is prescribed
};

/// Guidance: what is prescribed at the next level, from all of the committed one. Asked again for
/// the same level (by another request than the last), it answers from the same memory.
class GuidanceParticipant : public SolverParticipant {
 public:
  GuidanceParticipant(const CoupledModel& model, std::unique_ptr<Guidance> guidance);

 private:
  void onStart(const Request& request, Reply& reply) override;
  void onIterate(const Request& request, Reply& reply) override;
  void onCommit(const Request& request, Reply& reply) override;
  void memory(StateVisitor& state) override;
  bool sameGuess(const Interface& answered, const Interface& committed) const override;

  std::unique_ptr<Guidance> guidance_;
  StateSnapshot before_;  // guidance's memory of level n, while it stands at n+1
  bool ahead_ = false;    // it stands at n+1, which is not committed
};

}  // namespace monarch_flight
