#pragma once
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <map>
#include <memory>
#include <string>

#include "monarch_flight/ros_io/flight_messages.h"

namespace monarch_flight {

/// Publishes messages on their topics; /diagnostics goes through diagnostic_updater, once a second
/// of wall time. /clock is published by the first node that does so on this master: where another
/// run was first, this one leaves it to that and says so. The node's own clock follows the run
/// exactly, whether or not /use_sim_time is set.
class RosOutput : public MessageOutput {
 public:
  explicit RosOutput(const ros::NodeHandle& node);
  void open(const std::vector<StampedMessage>& topics) override;
  void write(const StampedMessage& message) override;
  void restart() override {}  // subscribers see the clock jump back
  void close() override;
  /// Diagnostics of a run that is held, where they are due.
  void keepAlive();

 private:
  void diagnose(const diagnostic_msgs::DiagnosticArray& diagnostics);

  ros::NodeHandle node_;
  std::map<std::string, ros::Publisher> publishers_;
  void ownClock();

  ros::SteadyTime diagnosed_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> statuses_;  // by name, of the last step
};

}  // namespace monarch_flight
