#pragma once
#include <monarch_flight/FlightState.h>
#include <monarch_flight/FlowBlock.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/ros_io/run_names.h"
#include "monarch_flight/viz/flow_scene.h"

namespace monarch_flight {

/// Shows the flow of a run, live or from its bag, in rviz: vortices, pressure on the wings, a slice
/// of vorticity, forces; and the insect, whose own wings give way to those coloured by pressure.
/// Makes what somebody listens to. Topics and parameters: docs/flow_view.md.
class FlowView {
 public:
  /// Throws InputError for a parameter out of its range.
  FlowView();

 private:
  void onCase(const std_msgs::String& text);
  void onModel(const visualization_msgs::MarkerArray& model);
  void onPressure(Side side, const sensor_msgs::PointCloud2& cloud);
  void onFlow(Side side, const FlowBlock& block);
  void onState(const FlightStateConstPtr& state);
  void onQLevel(const std_msgs::Float64& level);
  void onSliceAt(const std_msgs::Float64& share);
  void listen();
  void clear();
  void showInsect();
  void showPressure();
  void showVortices();
  void showSlice();
  void showForces();
  void showScales();
  bool learnPrefix(const std::string& frame);
  void publish(ros::Publisher& to, visualization_msgs::MarkerArray markers) const;

  RunNames names_;
  ros::NodeHandle node_;
  ros::Publisher insect_, pressure_, vortices_, slice_, forces_, scales_;
  std::vector<ros::Subscriber> heard_;
  double q_level_, slice_at_;
  std::string shown_;               // the case that the scene belongs to
  std::optional<FlowScene> scene_;  // none before the case is known
  std::string prefix_;              // of the insect's frames, as the messages have it
  visualization_msgs::MarkerArray model_;
  // The newest messages; those before the case are taken when it comes.
  PerWing<sensor_msgs::PointCloud2ConstPtr> clouds_;
  PerWing<FlowBlockConstPtr> blocks_;
  FlightStateConstPtr state_;
  ros::WallTime forces_shown_;
  ColourScales scales_shown_;
};

}  // namespace monarch_flight
