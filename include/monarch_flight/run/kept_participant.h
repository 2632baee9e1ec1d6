#pragma once
#include <memory>
#include <string>

#include "monarch_flight/coupling/participants.h"
#include "monarch_flight/run/checkpoint_files.h"

namespace monarch_flight {

/// A solver that also answers CHECKPOINT and RESTORE: it writes its own part of a checkpoint, and
/// takes it up again. In one process and in a node alike.
class KeptParticipant : public Participant {
 public:
  /// `part`: name of its part. `folder`: of the run's checkpoints; never taken from a message.
  KeptParticipant(const std::string& part, std::unique_ptr<SolverParticipant> solver,
                  const std::string& folder)
      : part_(part), solver_(std::move(solver)), files_(folder) {}
  Reply exchange(const Request& request) override;

 private:
  std::string part_;
  std::unique_ptr<SolverParticipant> solver_;
  CheckpointFiles files_;
};

}  // namespace monarch_flight
