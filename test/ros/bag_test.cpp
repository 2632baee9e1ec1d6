// What a flight in one process records: topics, counts, and that the messages agree with each
// other.
#include <gtest/gtest.h>
#include <monarch_flight/FlightState.h>
#include <monarch_flight/StepIterations.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sys/resource.h>
#include <tf2/buffer_core.h>

#include <cstring>
#include <map>

#include "monarch_flight/ros_io/flight_messages.h"
#include "monarch_flight/ros_io/state_conversions.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/viz/frames.h"
#include "monarch_flight/viz/pressure_cloud.h"
#include "ros/process.h"

namespace monarch_flight {
namespace {

constexpr int kSteps = 120;

std::string name(const char* topic) { return RunNames().topic(topic); }

/// One flight for all tests.
class Bag : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder();
    Process flight(std::string(NODE_DIR) + "/fly_in_process",
                   {"case:=climb_printed", "fluid:=quasi_steady", "steps_per_flap:=240",
                    "flaps:=0.5", "out:=" + (*folder / "run")},
                   *folder / "flight.log");
    ASSERT_EQ(0, flight.wait(60.0)) << flight.output();
    ASSERT_FALSE(exists(*folder / "run/flight.bag.active"));
    bag = new rosbag::Bag(*folder / "run/flight.bag");
    insect = new Case(loadCase("climb_printed", {{"steps_per_flap", "240"}}, CONFIG_DIR));
  }
  static void TearDownTestSuite() {
    delete bag;
    delete insect;
    delete folder;
  }
  template <class Message>
  static std::vector<boost::shared_ptr<Message>> all(const std::string& topic) {
    std::vector<boost::shared_ptr<Message>> out;
    rosbag::View view(*bag, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& m : view) out.push_back(m.instantiate<Message>());
    return out;
  }
  static TemporaryFolder* folder;
  static rosbag::Bag* bag;
  static Case* insect;
};
TemporaryFolder* Bag::folder = nullptr;
rosbag::Bag* Bag::bag = nullptr;
Case* Bag::insect = nullptr;

TEST_F(Bag, HoldsEveryTopicAsOftenAsExpected) {
  std::map<std::string, int> count;
  rosbag::View view(*bag);
  for (const rosbag::MessageInstance& m : view) ++count[m.getTopic()];
  std::map<std::string, int> expected;
  for (const char* every_step :
       {topics::kClock, topics::kTf, topics::kJointStates, topics::kState, topics::kOdometry,
        topics::kWind, topics::kRightWrench, topics::kLeftWrench, topics::kIterations}) {
    expected[name(every_step)] = kSteps + 1;
  }
  expected[topics::kTfStatic] = 1;
  expected[name(topics::kCase)] = 1;
  expected[name(topics::kModel)] = 1;
  expected[name(topics::kPath)] = 16;   // a pose in 240 / 32 = 7.5 -> 8 steps: 0, 8, .. 120
  expected[topics::kDiagnostics] = 11;  // every 12 steps: 0, 12, .. 120
  expected[name(topics::kRightPressure)] = kSteps / insect->output.surface_every;
  EXPECT_EQ(expected, count);
}

TEST_F(Bag, StampsRunFromOneSecondWithTheStep) {
  const auto clocks = all<rosgraph_msgs::Clock>(name(topics::kClock));
  ASSERT_EQ(kSteps + 1u, clocks.size());
  for (int i = 0; i <= kSteps; ++i) {
    EXPECT_EQ(stampOf(static_cast<std::uint32_t>(i), insect->time), clocks[i]->clock);
  }
  EXPECT_EQ(ros::Time(1, 0), clocks[0]->clock);
  rosbag::View view(*bag);
  for (const rosbag::MessageInstance& m : view) {
    if (const auto odometry = m.instantiate<nav_msgs::Odometry>()) {
      EXPECT_EQ(m.getTime(), odometry->header.stamp);
    }
  }
}

// Attitude and place of right_wing in world_ned, from tf alone, against the wing's motion that the
// flow solver is given for the recorded state.
TEST_F(Bag, TheTfTreeAloneGivesTheWings) {
  tf2::BufferCore buffer(ros::Duration(1000.0));
  for (const char* topic : {topics::kTfStatic, topics::kTf}) {
    for (const auto& message : all<tf2_msgs::TFMessage>(topic)) {
      for (const auto& t : message->transforms) {
        buffer.setTransform(t, "bag", topic == std::string(topics::kTfStatic));
      }
    }
  }
  const auto states = all<FlightState>(name(topics::kState));
  ASSERT_EQ(kSteps + 1u, states.size());
  for (const auto& state : states) {
    const JointAngles angles{
        {fromMessage(state->right_wing), fromMessage(state->left_wing)},
        {state->theta_a.position, state->theta_a.velocity, state->theta_a.acceleration}};
    const WingMotion wing =
        wingMotion(Side::kRight, insect->insect, fromMessage(state->body), angles);
    const auto tf =
        buffer.lookupTransform("world_ned", "right_wing", state->header.stamp).transform;
    const Eigen::Quaterniond q(tf.rotation.w, tf.rotation.x, tf.rotation.y, tf.rotation.z);
    EXPECT_LT((q.toRotationMatrix() - wing.R_IW).norm(), 1e-12);
    const Eigen::Vector3d r(tf.translation.x, tf.translation.y, tf.translation.z);
    EXPECT_LT((r - wing.r_I).norm(), 1e-15);

    // The left wing mirrors the right one across the body's x-z plane.
    const auto left =
        buffer.lookupTransform("body_frd", "left_wing", state->header.stamp).transform;
    const auto right =
        buffer.lookupTransform("body_frd", "right_wing", state->header.stamp).transform;
    EXPECT_NEAR(right.translation.y, -left.translation.y, 1e-15);
    const Eigen::Quaterniond ql(left.rotation.w, left.rotation.x, left.rotation.y, left.rotation.z);
    const Eigen::Quaterniond qr(right.rotation.w, right.rotation.x, right.rotation.y,
                                right.rotation.z);
    const Eigen::Matrix3d mirror = Eigen::Vector3d(1, -1, 1).asDiagonal();
    EXPECT_LT((mirror * qr.toRotationMatrix() * mirror - ql.toRotationMatrix()).norm(), 1e-12);
    EXPECT_TRUE(buffer.canTransform("world", "abdomen", state->header.stamp));
    EXPECT_TRUE(buffer.canTransform("base_link", "stroke_plane", state->header.stamp));
  }
}

TEST_F(Bag, OdometryIsTheStateInEastNorthUp) {
  const auto states = all<FlightState>(name(topics::kState));
  const auto odometry = all<nav_msgs::Odometry>(name(topics::kOdometry));
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState s = fromMessage(states[i]->body);
    const auto& o = *odometry[i];
    EXPECT_EQ("world", o.header.frame_id);
    EXPECT_EQ("base_link", o.child_frame_id);
    EXPECT_EQ(s.x.y(), o.pose.pose.position.x);
    EXPECT_EQ(s.x.x(), o.pose.pose.position.y);
    EXPECT_EQ(-s.x.z(), o.pose.pose.position.z);
    const Eigen::Quaterniond q(o.pose.pose.orientation.w, o.pose.pose.orientation.x,
                               o.pose.pose.orientation.y, o.pose.pose.orientation.z);
    const Eigen::Vector3d v(o.twist.twist.linear.x, o.twist.twist.linear.y, o.twist.twist.linear.z);
    EXPECT_LT((q * v - nedToEnu() * s.v).norm(), 1e-12);
    EXPECT_EQ(-s.Omega_B.y(), o.twist.twist.angular.y);  // nose down about left, positive
  }
}

TEST_F(Bag, TheTwoWrenchesTogetherAreTheForce) {
  const auto states = all<FlightState>(name(topics::kState));
  const auto right = all<geometry_msgs::WrenchStamped>(name(topics::kRightWrench));
  const auto left = all<geometry_msgs::WrenchStamped>(name(topics::kLeftWrench));
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState s = fromMessage(states[i]->body);
    const FlightState& m = *states[i];
    const WingAngles ours = fromMessage(m.right_wing), theirs = fromMessage(m.left_wing);
    const double beta = insect->insect.beta;
    const auto vector = [](const geometry_msgs::Vector3& v) {
      return Eigen::Vector3d(v.x, v.y, v.z);
    };
    EXPECT_EQ("right_wing", right[i]->header.frame_id);
    EXPECT_EQ("left_wing", left[i]->header.frame_id);
    const Eigen::Vector3d force =
        s.R_IB() * (wingAttitude(Side::kRight, beta, ours) * vector(right[i]->wrench.force) +
                    wingAttitude(Side::kLeft, beta, theirs) * vector(left[i]->wrench.force));
    const Eigen::Vector3d recorded = vector(m.force);
    EXPECT_LT((force - recorded).norm(), 1e-12 * (1e-3 + recorded.norm()));
    EXPECT_EQ(right[i]->wrench.torque.y, left[i]->wrench.torque.y);
    EXPECT_EQ(right[i]->wrench.torque.x, -left[i]->wrench.torque.x);
  }
}

TEST_F(Bag, TheIterationTableHasEverySubIteration) {
  const auto states = all<FlightState>(name(topics::kState));
  const auto tables = all<StepIterations>(name(topics::kIterations));
  std::size_t rows = 0;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    EXPECT_EQ(i, tables[i]->step);
    EXPECT_EQ(states[i]->sub_iterations, tables[i]->rows.size());
    for (std::size_t k = 0; k < tables[i]->rows.size(); ++k) {
      EXPECT_EQ(i, tables[i]->rows[k].step);
      EXPECT_EQ(k, tables[i]->rows[k].iteration);
    }
    rows += tables[i]->rows.size();
  }
  const std::string table = fileText(*folder / "run/iterations.csv");
  EXPECT_EQ(rows + 1, static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')));
}

struct Surfaces : StepSink {
  std::vector<CommittedStep> steps;  // with a picture
  void onStep(const CommittedStep& step) override {
    if (!step.surface.right.facets.empty()) steps.push_back(step);
  }
  void onReset() override {}
  void onEnd(const std::string& failure) override { EXPECT_EQ("", failure); }
};

TEST_F(Bag, HoldsThePressureOfTheSolver) {
  const Case c = loadCase("climb_printed",
                          {{"fluid", "quasi_steady"}, {"steps_per_flap", "240"}, {"flaps", "0.5"}},
                          CONFIG_DIR);
  Surfaces flown;
  const StopFlag stop{false};
  InProcessFederation(c).run(1, {&flown}, stop);
  const auto clouds = all<sensor_msgs::PointCloud2>(name(topics::kRightPressure));
  ASSERT_EQ(flown.steps.size(), clouds.size());
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ("right_wing", clouds[i]->header.frame_id);
    EXPECT_EQ(stampOf(flown.steps[i].step, c.time), clouds[i]->header.stamp);
    const auto recorded = surfacePressure(*clouds[i], Side::kRight);
    const auto& solved = flown.steps[i].surface.right.facets;
    ASSERT_TRUE(recorded);
    ASSERT_EQ(solved.size(), recorded->facets.size());
    EXPECT_EQ(0, std::memcmp(solved.data(), recorded->facets.data(),
                             solved.size() * sizeof(SurfacePressure::Facet)));
  }
}

TEST_F(Bag, TheCaseIsTheFileAndStaticTopicsAreLatched) {
  const auto recorded = all<std_msgs::String>(name(topics::kCase));
  ASSERT_EQ(1u, recorded.size());
  EXPECT_EQ(fileText(*folder / "run/case.yaml"), recorded[0]->data);
  rosbag::View view(*bag);
  int latched = 0;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    const auto found = connection->header->find("latching");
    if (found != connection->header->end() && found->second == "1") ++latched;
  }
  EXPECT_EQ(5, latched);  // tf_static, case, model, path, right_wing/pressure
}

TEST(PublishedWind, IsTheCommittedOneInEastNorthUp) {
  const Case c = loadCase("climb", {{"fluid", "quasi_steady"}}, CONFIG_DIR);
  FlightMessages messages(c);
  CommittedStep step;
  step.step = 3;
  step.guided.wind.v = Eigen::Vector3d(0.3, -0.2, 0.1);
  int found = 0;
  for (const StampedMessage& m : messages.of(step)) {
    if (m.topic != name(topics::kWind)) continue;
    const auto& wind = std::get<geometry_msgs::Vector3Stamped>(m.message);
    EXPECT_EQ("world", wind.header.frame_id);
    EXPECT_EQ(stampOf(3, c.time), wind.header.stamp);
    EXPECT_EQ(-0.2, wind.vector.x);
    EXPECT_EQ(0.3, wind.vector.y);
    EXPECT_EQ(-0.1, wind.vector.z);
    ++found;
  }
  EXPECT_EQ(1, found);
}

TEST(LongPath, StaysBoundedAndKeepsItsBeginning) {
  Case c =
      loadCase("climb_printed", {{"fluid", "quasi_steady"}, {"steps_per_flap", "320"}}, CONFIG_DIR);
  FlightMessages messages(c);
  std::size_t poses = 0, published = 0, bytes = 0;
  for (std::uint32_t step = 0; step <= 320 * 100; ++step) {
    CommittedStep s;
    s.step = step;
    s.interface.body.x.x() = step;
    for (const StampedMessage& m : messages.of(s)) {
      const auto* path = std::get_if<nav_msgs::Path>(&m.message);
      if (path == nullptr) continue;
      poses = path->poses.size();
      bytes += ros::serialization::serializationLength(*path);
      ++published;
      ASSERT_EQ(0.0, path->poses.front().pose.position.y);
      ASSERT_EQ(double(step), path->poses.back().pose.position.y);
    }
  }
  EXPECT_LE(poses, 400u);
  EXPECT_GE(poses, 200u);
  EXPECT_LT(published, 1200u);
  EXPECT_LT(bytes, 40u << 20);  // 100 flaps; all poses in all messages would be 400 MB
}

TEST(FullDisk, LeavesTheBagUnderItsActiveName) {
  TemporaryFolder folder;
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 150000;  // inherited by the flight; stands for a full disk
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  Process flight(
      std::string(NODE_DIR) + "/fly_in_process",
      {"case:=climb_printed", "fluid:=quasi_steady", "flaps:=20", "out:=" + (folder / "run")},
      folder / "flight.log");
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(1, flight.wait(30.0));
  EXPECT_NE(std::string::npos, flight.output().find("flight failed: ")) << flight.output();
  EXPECT_FALSE(exists(folder / "run/flight.bag"));
  EXPECT_TRUE(exists(folder / "run/flight.bag.active"));
}

}  // namespace
}  // namespace monarch_flight
