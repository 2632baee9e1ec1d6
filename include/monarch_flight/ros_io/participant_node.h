#pragma once
#include <ros/ros.h>

#include <memory>

#include "monarch_flight/ros_io/lockstep_server.h"
#include "monarch_flight/ros_io/run_parameters.h"

namespace monarch_flight {

/// The in-process participant of a role, made when the coordinator's START comes: a grid may take
/// long to factorise, and the handshake must not wait for it.
class ParticipantOnStart : public Participant {
 public:
  ParticipantOnStart(Role role, const Case& c) : role_(role), case_(c) {}
  Reply exchange(const Request& request) override;

 private:
  Role role_;
  const Case& case_;
  std::unique_ptr<Participant> participant_;
};

/// A solver node: serves one run of the coordinator and ends with it.
class ParticipantNode {
 public:
  /// Reads and checks the parameters of /monarch_flight. Throws InputError.
  ParticipantNode(Role role, const StopFlag& stop);
  /// Returns an exit code. Throws ExchangeError (see LockstepServer::serve).
  int run();

 private:
  Case case_;
  ParticipantOnStart participant_;
  LockstepServer server_;
};

}  // namespace monarch_flight
