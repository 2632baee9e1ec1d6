#pragma once
#include <memory>
#include <string>

#include "monarch_flight/coupling/model.h"
#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/flight/flight_solver.h"
#include "monarch_flight/wing/wing_pitch_solver.h"

namespace monarch_flight {

/// What the in-process participants have in common: keys, cache and failures.
///  - START takes the initial state and forgets everything else.
///  - ITERATE of step n+1 is answered from (committed state n, request); the last answer is kept, and
///    the same request again gets the same answer, bit for bit.
///  - COMMIT must carry the key (run, step, iteration) of the last answered ITERATE and its guess; the
///    request's interface becomes the committed state. The same COMMIT again is answered again.
///  - ABORT ends the run: only START is accepted after it.
/// Wrong keys, non-finite numbers and exceptions of a solver end in Reply::error, which names
/// participant, step and iteration; the committed state stays as it was.
class SolverParticipant : public Participant {
 public:
  Reply exchange(const Request& request) final;

 protected:
  SolverParticipant(Role role, const CoupledModel& model);
  const CoupledModel& model() const { return model_; }
  const Interface& committed() const { return committed_; }
  Role role() const { return role_; }

 private:
  virtual void onStart(const Request& request) = 0;
  virtual void onIterate(const Request& request, Reply& reply) = 0;
  /// `answered` is the ITERATE request that is kept. Throws std::invalid_argument when the interface to
  /// be committed is not the one that was answered.
  virtual void onCommit(const Request& request, const Request& answered, Reply& reply) = 0;

  Reply answer(const Request& request);
  void requireKey(const Request& request) const;

  Role role_;
  CoupledModel model_;
  Interface committed_;
  std::uint64_t run_ = 0;
  std::uint32_t step_ = 0;       // committed time level
  bool running_ = false;
  bool iterated_ = false;        // last_request_ is an answered ITERATE of step_ + 1
  bool answered_ = false;        // last_reply_ answers last_request_
  Request last_request_;
  Reply last_reply_;
};

/// The air: loads on the right wing for the guessed interface.
class FluidParticipant : public SolverParticipant {
 public:
  FluidParticipant(const CoupledModel& model, std::unique_ptr<FluidModel> fluid);
  const FluidModel& fluid() const { return *fluid_; }

 private:
  void onStart(const Request& request) override;
  void onIterate(const Request& request, Reply& reply) override;
  void onCommit(const Request& request, const Request& answered, Reply& reply) override;

  std::unique_ptr<FluidModel> fluid_;
};

/// The body: its state for the given loads and wing state.
class FlightParticipant : public SolverParticipant {
 public:
  explicit FlightParticipant(const CoupledModel& model);

 private:
  void onStart(const Request& request) override;
  void onIterate(const Request& request, Reply& reply) override;
  void onCommit(const Request& request, const Request& answered, Reply& reply) override;

  FlightSolver solver_;
};

/// The hinge: the wing's pitch for the given loads and body state.
class WingParticipant : public SolverParticipant {
 public:
  explicit WingParticipant(const CoupledModel& model);

 private:
  void onStart(const Request& request) override;
  void onIterate(const Request& request, Reply& reply) override;
  void onCommit(const Request& request, const Request& answered, Reply& reply) override;

  WingPitchSolver solver_;
};

}  // namespace monarch_flight
