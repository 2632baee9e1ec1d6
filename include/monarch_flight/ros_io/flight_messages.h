#pragma once
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <monarch_flight/FlightState.h>
#include <monarch_flight/StepIterations.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <string>
#include <variant>
#include <vector>

#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// Namespace of nodes, parameters and of the topics that belong to this package.
constexpr char kNamespace[] = "/monarch_flight";

/// Names of all topics, absolute.
namespace topics {
constexpr char kClock[] = "/clock";
constexpr char kTf[] = "/tf";
constexpr char kTfStatic[] = "/tf_static";
constexpr char kJointStates[] = "/joint_states";
constexpr char kDiagnostics[] = "/diagnostics";
constexpr char kCase[] = "/monarch_flight/case";
constexpr char kState[] = "/monarch_flight/state";
constexpr char kOdometry[] = "/monarch_flight/odom";
constexpr char kPath[] = "/monarch_flight/path";
constexpr char kWind[] = "/monarch_flight/wind";
constexpr char kRightWrench[] = "/monarch_flight/right_wing/wrench";
constexpr char kLeftWrench[] = "/monarch_flight/left_wing/wrench";
constexpr char kRightPressure[] = "/monarch_flight/right_wing/pressure";
constexpr char kLeftPressure[] = "/monarch_flight/left_wing/pressure";
constexpr char kVortices[] = "/monarch_flight/vortices";
constexpr char kIterations[] = "/monarch_flight/iterations";
// For rviz alone (PressureView): neither from the coordinator nor in a bag.
constexpr char kPressureMarkers[] = "/monarch_flight/pressure_markers";
constexpr char kPressureLegend[] = "/monarch_flight/pressure_legend";
}  // namespace topics

using FlightMessage =
    std::variant<rosgraph_msgs::Clock, tf2_msgs::TFMessage, sensor_msgs::JointState,
                 diagnostic_msgs::DiagnosticArray, std_msgs::String, FlightState,
                 nav_msgs::Odometry, nav_msgs::Path, geometry_msgs::Vector3Stamped,
                 geometry_msgs::WrenchStamped, sensor_msgs::PointCloud2, StepIterations>;

/// A message with its place and time: what is published and what is recorded are the same.
struct StampedMessage {
  std::string topic;
  ros::Time stamp;
  FlightMessage message;
  bool latched = false;
};

/// Stamp of a step: 1 s + step dt (rosbag refuses 0), rounded to a nanosecond from the integer
/// step, so that nothing accumulates.
ros::Time stampOf(std::uint32_t step, const TimeGrid& time);

/// Turns committed steps into messages; keeps the path flown so far.
class FlightMessages {
 public:
  explicit FlightMessages(const Case& c);
  /// Every topic that may come, with an empty message of its type.
  std::vector<StampedMessage> topics() const;
  /// What comes once, before the first step: static transforms and the case.
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

  Case case_;
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
  MessageSink(const Case& c, std::vector<MessageOutput*> outputs, StateVisitor* resumed = nullptr);
  void onStep(const CommittedStep& step) override;
  void onReset() override;
  void onCheckpoint(StateVisitor& state) override;
  void onEnd(const std::string& failure) override;

 private:
  void write(const std::vector<StampedMessage>& messages);

  Case case_;
  FlightMessages messages_;
  std::vector<MessageOutput*> outputs_;
};

}  // namespace monarch_flight
