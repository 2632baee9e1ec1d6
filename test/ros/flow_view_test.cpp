// The node flow_view between a flight and its watcher.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include "monarch_flight/ros_io/fluid_conversions.h"
#include "monarch_flight/ros_io/run_names.h"
#include "monarch_flight/viz/flow_scene.h"
#include "monarch_flight/viz/model_markers.h"
#include "monarch_flight/viz/pressure_cloud.h"
#include "ros/flow_samples.h"
#include "ros/process.h"

namespace monarch_flight {
namespace {

using visualization_msgs::Marker;

/// The node as it stands beside rviz, between a flight and its watcher.
class Viewer : public testing::Test {
 protected:
  template <class Message>
  void publish(const char* topic, const Message& message) {
    publishers_.push_back(node_.advertise<Message>(RunNames().topic(topic), 1, true));
    publishers_.back().publish(message);
  }
  template <class Message>
  void listen(const char* topic, std::vector<Message>& into) {
    subscribers_.push_back(node_.subscribe<Message>(
        RunNames().topic(topic), 10,
        [&into](const boost::shared_ptr<Message const>& m) { into.push_back(*m); }));
  }
  template <class Condition>
  bool comes(Condition condition) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20.0);
    while (!condition() && ros::WallTime::now() < end) {
      ros::spinOnce();
      ros::WallDuration(0.01).sleep();
    }
    return condition();
  }
  void shows(const std::string& prefix);
  ros::NodeHandle node_;
  std::vector<ros::Publisher> publishers_;
  std::vector<ros::Subscriber> subscribers_;
  TemporaryFolder folder_;
};

const Marker* ofFrame(const visualization_msgs::MarkerArray& array, const std::string& frame) {
  for (const Marker& marker : array.markers)
    if (marker.header.frame_id == frame) return &marker;
  return nullptr;
}

/// The insect's frames have a prefix, which no parameter tells.
void Viewer::shows(const std::string& prefix) {
  const Case c = caseWith("mirrored");
  visualization_msgs::MarkerArray model = modelMarkers(c.insect);
  for (Marker& part : model.markers) part.header.frame_id = prefix + part.header.frame_id;
  publish(topics::kModel, model);
  sensor_msgs::PointCloud2 cloud = pressureCloud(surface(1.0f), Side::kRight, {2, 0});
  cloud.header.frame_id = prefix + cloud.header.frame_id;
  publish(topics::kRightPressure, cloud);
  FlowBlock block = toMessage(ball(0.01f));
  block.step *= 1e3f;  // Q as strong as the wing's edges have it
  block.header.frame_id = prefix + "right_wing";
  block.header.stamp = {2, 0};
  publish(topics::kRightFlow, block);
  std_msgs::String text;
  text.data = c.resolved_yaml;
  publish(topics::kCase, text);
  std::vector<visualization_msgs::MarkerArray> insect, pressure, vortices;
  std::vector<ColourScales> scales;
  listen(topics::kInsectMarkers, insect);
  listen(topics::kColourScales, scales);
  Process viewer(std::string(NODE_DIR) + "/flow_view", {}, folder_ / "viewer.log");
  ASSERT_TRUE(comes([&] {
    return !insect.empty() && !scales.empty() && scales.back().scales.size() == 2;
  })) << viewer.output();
  // Nobody listens to the pressure: the wings have their pattern.
  const Marker* wing = ofFrame(insect.back(), prefix + "left_wing");
  ASSERT_NE(nullptr, wing);
  EXPECT_EQ(Marker::ADD, wing->action);
  EXPECT_EQ(wing->points.size(), wing->colors.size());
  EXPECT_EQ("pressure coefficient", scales.back().scales[0].quantity);

  listen(topics::kPressureMarkers, pressure);
  listen(topics::kVortexMarkers, vortices);
  ASSERT_TRUE(comes([&] {
    return !pressure.empty() && !vortices.empty() &&
           ofFrame(insect.back(), prefix + "left_wing")->action == Marker::DELETE;
  })) << viewer.output();
  EXPECT_EQ(Marker::ADD, ofFrame(insect.back(), prefix + "body_frd")->action);
  EXPECT_NE(nullptr, ofFrame(pressure.back(), prefix + "right_wing"));
  EXPECT_NE(nullptr, ofFrame(pressure.back(), prefix + "left_wing"));
  ASSERT_EQ(2u, vortices.back().markers.size());
  const std::size_t corners = vortices.back().markers[0].points.size();
  EXPECT_EQ(hasIsoSurfaces(), corners > 0);
  EXPECT_EQ(prefix + "left_wing", vortices.back().markers[1].header.frame_id);

  const std::size_t before = vortices.size();  // a level that no air here reaches
  std_msgs::Float64 level;
  level.data = 1e9;
  publish(topics::kQLevel, level);
  EXPECT_TRUE(comes([&] { return vortices.size() > before; })) << viewer.output();
  EXPECT_TRUE(vortices.back().markers[0].points.empty());

  subscribers_.erase(subscribers_.begin() + 2);  // the pressure is not looked at any more
  EXPECT_TRUE(comes([&] {
    return ofFrame(insect.back(), prefix + "left_wing")->action == Marker::ADD;
  })) << viewer.output();
  viewer.send(SIGINT);
  EXPECT_EQ(0, viewer.wait(5.0)) << viewer.output();
}

TEST_F(Viewer, MakesWhatIsListenedToAndHidesTheWingsThatPressureCovers) { shows(""); }

TEST_F(Viewer, TakesThePrefixOfTheFramesFromTheMessages) { shows("lab/a/"); }

TEST_F(Viewer, RefusesAParameterOutOfItsRange) {
  Process viewer(std::string(NODE_DIR) + "/flow_view", {"_q_level:=-1"}, folder_ / "viewer.log");
  EXPECT_EQ(2, viewer.wait(10.0));
  EXPECT_NE(std::string::npos, viewer.output().find("q_level = -1.000000: must be above 0"))
      << viewer.output();
}

}  // namespace
}  // namespace monarch_flight
