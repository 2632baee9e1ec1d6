#pragma once
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <optional>
#include <string>

#include "monarch_flight/ros_io/run_names.h"
#include "monarch_flight/viz/pressure_picture.h"

namespace monarch_flight {

/// Shows the pressure of the wings in rviz: colours from the topics of the numbers, of a flight or
/// of its bag, and their legend, once, in a frame that follows the body and does not turn with it.
/// Works from the latched case.
class PressureView {
 public:
  PressureView();

 private:
  void onCase(const std_msgs::String& text);
  void onPressure(Side side, const sensor_msgs::PointCloud2ConstPtr& cloud);
  void onTransforms(const tf2_msgs::TFMessage& transforms);
  void show(Side side);
  void showLegend();
  void follow(const geometry_msgs::TransformStamped& body);
  visualization_msgs::MarkerArray named(visualization_msgs::MarkerArray markers) const;

  RunNames names_;
  ros::NodeHandle node_;
  ros::Publisher markers_, legend_, transforms_;
  ros::Subscriber case_, tf_;
  PerWing<ros::Subscriber> pressure_;
  std::string shown_;  // the case that the picture belongs to
  std::optional<PressurePicture> picture_;
  std::optional<std::string> prefix_;  // of the insect's frames, as the clouds have it
  std::map<std::string, geometry_msgs::TransformStamped> bodies_;  // the newest of each prefix
  PerWing<sensor_msgs::PointCloud2ConstPtr> newest_;
};

}  // namespace monarch_flight
