#pragma once
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "monarch_flight/coupling/guidance.h"
#include "monarch_flight/ros_io/lockstep_server.h"
#include "monarch_flight/ros_io/run_names.h"
#include "monarch_flight/ros_io/run_parameters.h"

namespace monarch_flight {

/// The in-process participant of a role, made when the coordinator's START comes: a grid may take
/// long to factorise, and the handshake must not wait for it.
class ParticipantOnStart : public Participant {
 public:
  /// `checkpoints`: their folder -> the participant.
  using Make = std::function<std::unique_ptr<Participant>(const std::string& checkpoints)>;
  explicit ParticipantOnStart(Make make) : make_(std::move(make)) {}
  Reply exchange(const Request& request) override;

 private:
  Make make_;
  std::unique_ptr<Participant> participant_;
};

/// A solver node, or a guidance node of one's own: serves one run of the coordinator and ends with
/// it.
class ParticipantNode {
 public:
  /// Reads and checks the parameters of the node's namespace. Throws InputError.
  ParticipantNode(Role role, const StopFlag& stop);
  /// The guidance node, with what `make` returns for the case.
  ParticipantNode(const StopFlag& stop,
                  const std::function<std::unique_ptr<Guidance>(const Case&)>& make);
  /// Returns an exit code. Throws ExchangeError (see LockstepServer::serve).
  int run();

 private:
  RunNames names_;
  Case case_;
  ParticipantOnStart participant_;
  LockstepServer server_;
};

}  // namespace monarch_flight
