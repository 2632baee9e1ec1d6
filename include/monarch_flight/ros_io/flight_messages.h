#pragma once
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <monarch_flight/FlightState.h>
#include <monarch_flight/FlowBlock.h>
#include <monarch_flight/StepIterations.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <variant>
#include <vector>

#include "monarch_flight/ros_io/run_names.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

using FlightMessage =
    std::variant<rosgraph_msgs::Clock, tf2_msgs::TFMessage, sensor_msgs::JointState,
                 diagnostic_msgs::DiagnosticArray, std_msgs::String, FlightState,
                 nav_msgs::Odometry, nav_msgs::Path, geometry_msgs::Vector3Stamped,
                 geometry_msgs::WrenchStamped, sensor_msgs::PointCloud2, FlowBlock,
                 visualization_msgs::MarkerArray, StepIterations>;

/// A message with its place and time: what is published and what is recorded are the same.
struct StampedMessage {
  std::string topic;  ///< absolute
  ros::Time stamp;
  FlightMessage message;
  bool latched = false;
};

/// Stamp of a step: 1 s + step dt (rosbag refuses 0), rounded to a nanosecond from the integer
/// step, so that nothing accumulates.
ros::Time stampOf(std::uint32_t step, const TimeGrid& time);

/// Turns committed steps into messages, with the names of the run; keeps the path flown so far.
class FlightMessages {
 public:
  explicit FlightMessages(const Case& c, const RunNames& names = RunNames());
  /// Every topic that may come, with an empty message of its type.
  std::vector<StampedMessage> topics() const;
  /// What comes once, before the first step: static transforms, the case and the insect's shape.
  std::vector<StampedMessage> opening() const;
  /// What follows from a step, /clock first.
  std::vector<StampedMessage> of(const CommittedStep& step);
  /// The path flown, to keep and to go on from.
  void memory(StateVisitor& state);

 private:
  bool growPath(const CommittedStep& step, const ros::Time& stamp);
  void addPictures(const CommittedStep& step, const ros::Time& stamp,
                   std::vector<StampedMessage>& out) const;
  diagnostic_msgs::DiagnosticArray diagnostics(const CommittedStep& step,
                                               const ros::Time& stamp) const;
  void name(std::vector<StampedMessage>& messages) const;

  Case case_;
  RunNames names_;
  nav_msgs::Path path_;
  std::uint32_t path_stride_;         // steps between poses of the path
  std::uint32_t diagnostics_stride_;  // steps between diagnostics
};

/// Where messages go: topics (RosOutput) or a bag (BagOutput).
class MessageOutput {
 public:
  virtual ~MessageOutput() = default;
  virtual void open(const std::vector<StampedMessage>& topics) = 0;
  virtual void write(const StampedMessage& message) = 0;
  /// What has been written is void; the opening and level 0 come again.
  virtual void restart() = 0;
  /// See StepSink::onCheckpoint.
  virtual void onCheckpoint(StateVisitor&) {}
  /// Whether it goes on from a checkpoint, the opening included.
  virtual bool resumed() const { return false; }
  /// The run is over.
  virtual void close() = 0;
};

/// Builds the messages of a step once and hands them to all outputs.
class MessageSink : public StepSink {
 public:
  /// Opens the outputs and writes what comes before the first step. Outputs must outlive the sink.
  /// `resumed`: what `onCheckpoint` has shown, for a run that goes on.
  MessageSink(const Case& c, const RunNames& names, std::vector<MessageOutput*> outputs,
              StateVisitor* resumed = nullptr);
  void onStep(const CommittedStep& step) override;
  void onReset() override;
  void onCheckpoint(StateVisitor& state) override;
  void onEnd(const std::string& failure) override;

 private:
  void write(const std::vector<StampedMessage>& messages);

  Case case_;
  RunNames names_;
  FlightMessages messages_;
  std::vector<MessageOutput*> outputs_;
};

}  // namespace monarch_flight
