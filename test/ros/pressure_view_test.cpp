// Pressure as numbers on a topic, and the colours that the viewer makes of them for rviz.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cstring>
#include <map>

#include "monarch_flight/ros_io/flight_messages.h"
#include "monarch_flight/viz/colours.h"
#include "monarch_flight/viz/pressure_cloud.h"
#include "monarch_flight/viz/pressure_markers.h"
#include "monarch_flight/viz/pressure_picture.h"
#include "ros/process.h"

namespace monarch_flight {
namespace {

using visualization_msgs::Marker;

Case caseWith(const std::string& wings) {
  return loadCase("climb_printed", {{"fluid", "quasi_steady"}, {"wings", wings}}, CONFIG_DIR);
}

SurfacePressure surface(float p) {
  return {{{-0.01f, 0.02f, 0.002f, 0.004f, p, -2.0f * p}, {0.01f, 0.03f, 0.003f, 0.005f, 0.0f, p}}};
}

/// Field `name` of point i.
float number(const sensor_msgs::PointCloud2& cloud, std::size_t i, const std::string& name) {
  for (const sensor_msgs::PointField& field : cloud.fields) {
    if (field.name != name) continue;
    float value;
    std::memcpy(&value, cloud.data.data() + i * cloud.point_step + field.offset, sizeof value);
    return value;
  }
  ADD_FAILURE() << "no field " << name;
  return 0.0f;
}

TEST(PressureCloud, HasAPointAFacetInTheTrueAxesOfTheWing) {
  const ros::Time stamp(3, 4);
  const auto right = pressureCloud(surface(5.0f), Side::kRight, stamp);
  const auto left = pressureCloud(surface(5.0f), Side::kLeft, stamp);
  EXPECT_EQ("right_wing", right.header.frame_id);
  EXPECT_EQ("left_wing", left.header.frame_id);
  EXPECT_EQ(stamp, left.header.stamp);
  EXPECT_EQ(2u, left.width);
  const std::map<std::string, float> expected = {
      {"x", -0.01f},  {"y", 0.02f},      {"z", 0.0f},         {"dx", 0.002f},
      {"dy", 0.004f}, {"p_upper", 5.0f}, {"p_lower", -10.0f}, {"jump", 15.0f}};
  for (const auto& [name, value] : expected) {
    EXPECT_EQ(value, number(right, 0, name)) << name;
    EXPECT_EQ(name == "y" ? -value : value, number(left, 0, name)) << name;
  }
  EXPECT_EQ(-5.0f, number(right, 1, "jump"));
}

TEST(PressureCloud, GivesTheSurfaceBackAndRefusesOtherClouds) {
  for (Side side : kSides) {
    auto cloud = pressureCloud(surface(5.0f), side, ros::Time(1, 0));
    const auto back = surfacePressure(cloud, side);
    ASSERT_TRUE(back);
    const SurfacePressure same = surface(5.0f);
    ASSERT_EQ(2u, back->facets.size());
    EXPECT_EQ(0, std::memcmp(same.facets.data(), back->facets.data(),
                             2 * sizeof(SurfacePressure::Facet)));
    auto other = cloud;
    other.fields[5].name = "p";
    EXPECT_FALSE(surfacePressure(other, side));
    other = cloud;
    other.data.pop_back();
    EXPECT_FALSE(surfacePressure(other, side));
  }
}

TEST(PublishedPressure, OfIndependentWingsIsTheirOwnAndOfMirroredOnesTheRightOne) {
  CommittedStep step;
  step.step = 10;
  step.surface = {surface(5.0f), surface(7.0f)};
  for (const std::string wings : {"mirrored", "independent"}) {
    FlightMessages messages(caseWith(wings));
    std::map<std::string, sensor_msgs::PointCloud2> clouds;
    for (const StampedMessage& m : messages.of(step)) {
      const auto* cloud = std::get_if<sensor_msgs::PointCloud2>(&m.message);
      if (cloud != nullptr) clouds[m.topic] = *cloud;
    }
    ASSERT_EQ(wings == "mirrored" ? 1u : 2u, clouds.size());
    EXPECT_EQ(5.0f, number(clouds.at(RunNames().topic(topics::kRightPressure)), 0, "p_upper"));
    if (wings == "independent") {
      EXPECT_EQ(7.0f, number(clouds.at(RunNames().topic(topics::kLeftPressure)), 0, "p_upper"));
    }
  }
}

TEST(PressurePicture, ColoursBothSidesOfBothWings) {
  const Case c = caseWith("mirrored");
  PressurePicture picture(c);
  const float p = static_cast<float>(0.3 * pressureReference(c).dynamic);
  const auto all = picture.add(Side::kRight, pressureCloud(surface(p), Side::kRight, {2, 0}));
  ASSERT_TRUE(all);
  ASSERT_EQ(2u, all->markers.size());
  const Marker &right = all->markers[0], &left = all->markers[1];
  EXPECT_EQ("right_wing", right.header.frame_id);
  EXPECT_EQ("left_wing", left.header.frame_id);
  ASSERT_EQ(2u * 2u * 6u, right.points.size());  // facets, sides, two triangles
  ASSERT_EQ(right.points.size(), 3 * right.colors.size());
  ASSERT_EQ(right.points.size(), left.points.size());
  for (std::size_t i = 0; i < right.points.size(); ++i) {
    EXPECT_EQ(right.points[i].x, left.points[i].x);
    EXPECT_EQ(right.points[i].y, -left.points[i].y);
  }
  EXPECT_LT(right.points[0].z, 0.0);  // dorsal
  EXPECT_NEAR(divergingColour(0.3).r, right.colors[0].r, 1e-6);
  EXPECT_GT(right.points[6].z, 0.0);  // ventral
  EXPECT_NEAR(divergingColour(-0.6).r, right.colors[2].r, 1e-6);
}

TEST(PressurePicture, WaitsForBothWingsOfATime) {
  PressurePicture picture(caseWith("independent"));
  const auto cloud = [](Side side, unsigned s) {
    return pressureCloud(surface(1.0f), side, ros::Time(s, 0));
  };
  EXPECT_FALSE(picture.add(Side::kRight, cloud(Side::kRight, 1)));
  EXPECT_TRUE(picture.add(Side::kLeft, cloud(Side::kLeft, 1)));
  EXPECT_FALSE(picture.add(Side::kLeft, cloud(Side::kLeft, 2)));
  EXPECT_TRUE(picture.add(Side::kRight, cloud(Side::kRight, 2)));
}

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

/// The insect's frames have a prefix, which no parameter tells.
void Viewer::shows(const std::string& prefix) {
  const Case c = caseWith("mirrored");
  tf2_msgs::TFMessage pose;
  pose.transforms.resize(1);
  pose.transforms[0].header.frame_id = "world";
  pose.transforms[0].child_frame_id = prefix + "base_link";
  pose.transforms[0].transform.translation.x = 0.25;
  pose.transforms[0].transform.rotation.x = 1.0;
  publish(topics::kTf, pose);
  sensor_msgs::PointCloud2 cloud = pressureCloud(surface(1.0f), Side::kRight, {2, 0});
  cloud.header.frame_id = prefix + cloud.header.frame_id;
  publish(topics::kRightPressure, cloud);
  std_msgs::String text;
  text.data = c.resolved_yaml;
  publish(topics::kCase, text);
  std::vector<visualization_msgs::MarkerArray> colours, legends;
  std::vector<tf2_msgs::TFMessage> transforms;
  listen(topics::kPressureMarkers, colours);
  listen(topics::kPressureLegend, legends);
  listen(topics::kTf, transforms);
  Process viewer(std::string(NODE_DIR) + "/pressure_view", {}, folder_ / "viewer.log");
  const auto ofLegend = [&, name = prefix +
                                   "pressure_legend"]() -> const geometry_msgs::TransformStamped* {
    for (const auto& message : transforms) {
      for (const auto& t : message.transforms)
        if (t.child_frame_id == name) return &t;
    }
    return nullptr;
  };
  ASSERT_TRUE(comes([&] { return !colours.empty() && !legends.empty() && ofLegend() != nullptr; }))
      << viewer.output();
  EXPECT_EQ(2u, colours[0].markers.size());
  EXPECT_EQ(prefix + "right_wing", colours[0].markers[0].header.frame_id);
  EXPECT_EQ("world", ofLegend()->header.frame_id);
  EXPECT_EQ(0.25, ofLegend()->transform.translation.x);
  EXPECT_EQ(1.0, ofLegend()->transform.rotation.w);  // it does not turn
  EXPECT_EQ(0.0, ofLegend()->transform.rotation.x);
  int numbers = 0;
  for (const Marker& marker : legends[0].markers) {
    EXPECT_EQ(prefix + "pressure_legend", marker.header.frame_id);
    EXPECT_TRUE(marker.frame_locked);
    if (marker.type == Marker::TEXT_VIEW_FACING) ++numbers;
  }
  EXPECT_EQ(6, numbers);         // five numbers and the title
  publishers_[2].publish(text);  // a bag that is played again
  cloud.header.stamp = {3, 0};
  publishers_[1].publish(cloud);
  EXPECT_TRUE(comes([&] { return colours.size() == 2; }));
  EXPECT_EQ(1u, legends.size());
  viewer.send(SIGINT);
  EXPECT_EQ(0, viewer.wait(5.0)) << viewer.output();
}

TEST_F(Viewer, ShowsColoursLegendAndTheLegendsFrame) { shows(""); }

TEST_F(Viewer, TakesThePrefixOfTheFramesFromTheClouds) { shows("lab/a/"); }

}  // namespace
}  // namespace monarch_flight
