#pragma once
#include <ros/ros.h>

#include <array>
#include <memory>

#include "monarch_flight/ros_io/lockstep_client.h"
#include "monarch_flight/ros_io/run_parameters.h"

namespace monarch_flight {

/// The node that leads a run: greets the three solver nodes, couples them, publishes and records.
class CoordinatorNode {
 public:
  /// Reads and checks the parameters of /monarch_flight. Throws InputError.
  explicit CoordinatorNode(const StopFlag& stop);
  /// Runs the whole case; returns an exit code. Throws InputError, ExchangeError, OutputError for
  /// what goes wrong before the first step.
  int run();

 private:
  int fly();
  void keepAlive();
  void dismiss() noexcept;
  void reportIgnored() const;

  const StopFlag& stop_;
  RunParameters parameters_;
  Case case_;
  ros::NodeHandle node_;
  LockstepRun run_;
  std::array<std::unique_ptr<RosParticipant>, 3> solvers_;  // by role
};

}  // namespace monarch_flight
