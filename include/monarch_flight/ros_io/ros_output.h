#pragma once
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <map>
#include <memory>
#include <string>

#include "monarch_flight/ros_io/flight_messages.h"

namespace monarch_flight {

/// Publishes messages on their topics; /diagnostics goes through diagnostic_updater. The node's own
/// clock follows /clock exactly, whether or not /use_sim_time is set.
class RosOutput : public MessageOutput {
 public:
  explicit RosOutput(const ros::NodeHandle& node);
  void open(const std::vector<StampedMessage>& topics) override;
  void write(const StampedMessage& message) override;
  void restart() override {}  // subscribers see the clock jump back
  void close() override {}

 private:
  void diagnose(const diagnostic_msgs::DiagnosticArray& diagnostics);

  ros::NodeHandle node_;
  std::map<std::string, ros::Publisher> publishers_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> statuses_;  // by name, of the last step
};

}  // namespace monarch_flight
