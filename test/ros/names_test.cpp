// Several insects on one master: names of topics and frames, the clock.
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <set>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/flight_messages.h"
#include "monarch_flight/ros_io/run_parameters.h"
#include "ros/nodes_fixture.h"

namespace monarch_flight {
namespace {

TEST(RunNames, FollowTheNamespace) {
  const RunNames alone, lab("/lab/a/monarch_flight"), other("/bf1"), root("/");
  EXPECT_EQ("/monarch_flight/state", alone.topic(topics::kState));
  EXPECT_EQ("/joint_states", alone.topic(topics::kJointStates));
  EXPECT_EQ("/tf", lab.topic(topics::kTf));
  EXPECT_EQ("/lab/a/monarch_flight/state", lab.topic(topics::kState));
  EXPECT_EQ("/lab/a/joint_states", lab.topic(topics::kJointStates));
  EXPECT_EQ("/bf1/state", other.topic(topics::kState));
  EXPECT_EQ("/bf1/joint_states", other.topic(topics::kJointStates));
  EXPECT_EQ("/state", root.topic(topics::kState));
  EXPECT_EQ("/joint_states", root.topic(topics::kJointStates));
}

TEST(RunNames, PrefixTheFramesOfAnInsect) {
  EXPECT_EQ("base_link", RunNames().frame("base_link"));
  EXPECT_EQ("lab/a/base_link", RunNames("/lab/a/monarch_flight").frame("base_link"));
  EXPECT_EQ("bf1/base_link", RunNames("/bf1").frame("base_link"));
  EXPECT_EQ("base_link", RunNames("/").frame("base_link"));
  EXPECT_EQ("mine/base_link", RunNames("/a/monarch_flight", "mine").frame("base_link"));
  EXPECT_EQ("mine/base_link", RunNames("/a/monarch_flight", "/mine/").frame("base_link"));
  EXPECT_EQ("world", RunNames("/a/monarch_flight").frame("world"));
}

std::set<std::string> framesOf(const FlightMessage& message) {
  std::set<std::string> out;
  const auto add = [&out](const auto& content) {
    using Message = std::decay_t<decltype(content)>;
    if constexpr (std::is_same_v<Message, tf2_msgs::TFMessage>) {
      for (const auto& t : content.transforms) out.insert({t.header.frame_id, t.child_frame_id});
    } else if constexpr (std::is_same_v<Message, visualization_msgs::MarkerArray>) {
      for (const auto& marker : content.markers) out.insert(marker.header.frame_id);
    } else if constexpr (ros::message_traits::HasHeader<Message>::value) {
      out.insert(content.header.frame_id);
    }
  };
  std::visit(add, message);
  return out;
}

TEST(RunNames, StandInEveryMessage) {
  const Case c = loadCase("climb_printed", {{"fluid", "quasi_steady"}}, CONFIG_DIR);
  FlightMessages messages(c, RunNames("/a/monarch_flight"));
  CommittedStep step;
  std::vector<StampedMessage> all = messages.opening();
  for (StampedMessage& message : messages.of(step)) all.push_back(message);
  std::set<std::string> frames;
  for (const StampedMessage& message : all) {
    frames.merge(framesOf(message.message));
    const bool shared = message.topic == "/clock" || message.topic == "/tf" ||
                        message.topic == "/tf_static" || message.topic == "/diagnostics";
    EXPECT_TRUE(shared || message.topic.rfind("/a/", 0) == 0) << message.topic;
  }
  const std::set<std::string> expected = {"",
                                          "world",
                                          "world_ned",
                                          "a/base_link",
                                          "a/body_frd",
                                          "a/stroke_plane",
                                          "a/abdomen",
                                          "a/right_wing_flapping",
                                          "a/right_wing_deviation",
                                          "a/right_wing",
                                          "a/left_wing_flapping",
                                          "a/left_wing_deviation",
                                          "a/left_wing"};
  EXPECT_EQ(expected, frames);
}

/// Two runs in namespaces of their own.
class TwoInsects : public Nodes {
 protected:
  void begin(const std::string& space, const char* flaps) {
    const std::string own = space + "/monarch_flight";
    for (const auto& [key, value] :
         std::map<std::string, std::string>{{"case", "climb_printed"},
                                            {"fluid", "quasi_steady"},
                                            {"flaps", flaps},
                                            {"out", folder / space.substr(1)},
                                            {"token_file", folder / "token"}})
      ros::param::set(own + "/" + key, value);
    setenv("ROS_NAMESPACE", own.c_str(), 1);
    for (const char* name : {"coordinator", "fluid", "flight", "wing"})
      nodes.push_back(start(name, space.substr(1) + name));
    unsetenv("ROS_NAMESPACE");
  }
  std::vector<std::unique_ptr<Process>> nodes;
};

TEST_F(TwoInsects, FlyOnOneMasterAndTheFirstOwnsTheClock) {
  begin("/a", "3");
  ASSERT_TRUE(nodes[0]->prints("results in", 20.0)) << nodes[0]->output();
  begin("/b", "0.1");
  EXPECT_EQ(0, nodes[4]->wait(40.0)) << nodes[4]->output();
  EXPECT_TRUE(nodes[4]->prints("/clock is that of /a/monarch_flight/coordinator", 5.0))
      << nodes[4]->output();
  EXPECT_EQ(0, nodes[0]->wait(60.0)) << nodes[0]->output();
  EXPECT_FALSE(contains(nodes[0]->output(), "/clock is that of"));
  EXPECT_EQ("complete", summary("a")["status"]);
  EXPECT_EQ(50, summary("b")["steps"]);
}

TEST_F(Nodes, WithoutParametersOfARunInItsNamespaceANodeRefuses) {
  setenv("ROS_NAMESPACE", "/nowhere", 1);
  for (const char* name : {"coordinator", "fluid", "flight", "wing"}) {
    const auto node = start(name);
    EXPECT_EQ(2, node->wait(10.0)) << node->output();
    EXPECT_TRUE(contains(node->output(), "there is no run in namespace /nowhere"))
        << node->output();
  }
  unsetenv("ROS_NAMESPACE");
}

TEST_F(Nodes, PrivateParametersOfOthersDoNotMatter) {
  ros::param::set("/monarch_flight/stranger/rate", 5);
  startAll();
  EXPECT_EQ(0, coordinator->wait(40.0)) << coordinator->output();
}

}  // namespace
}  // namespace monarch_flight
