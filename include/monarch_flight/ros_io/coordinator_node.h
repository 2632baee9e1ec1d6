#pragma once
#include <monarch_flight/WingbeatCommand.h>
#include <ros/ros.h>

#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/guidance/command_inbox.h"
#include "monarch_flight/ros_io/lockstep_client.h"
#include "monarch_flight/ros_io/ros_output.h"
#include "monarch_flight/ros_io/run_parameters.h"
#include "monarch_flight/ros_io/token_file.h"

namespace monarch_flight {

/// The node that leads a run: greets the solver nodes, and the guidance node where the case has
/// one, couples them, publishes and records.
class CoordinatorNode {
 public:
  /// Reads and checks the parameters of the node's namespace. Throws InputError.
  explicit CoordinatorNode(const StopFlag& stop);
  /// Runs the whole case; returns an exit code. Throws InputError, ExchangeError, OutputError for
  /// what goes wrong before the first step.
  int run();

 private:
  int fly();
  void keepAlive();
  std::unique_ptr<Participant> makeGuidance(const std::string& checkpoints);
  void onCommand(const WingbeatCommandConstPtr& command);
  void dismiss() noexcept;
  void reportIgnored() const;

  const StopFlag& stop_;
  RunNames names_;
  RunParameters parameters_;
  Case case_;
  ros::NodeHandle node_;
  TokenFile token_;
  LockstepRun run_;
  std::vector<std::unique_ptr<RosParticipant>> nodes_;  // by role; the last one only of kNode
  std::shared_ptr<CommandInbox> inbox_;                 // of kCommands and kNode
  std::unique_ptr<Participant> own_;  // guidance in this process, behind that of a node
  std::unique_ptr<RosOutput> topics_;
  ros::Subscriber commands_;
};

}  // namespace monarch_flight
