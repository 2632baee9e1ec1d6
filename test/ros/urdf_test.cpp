// The URDF moved by robot_state_publisher from joint states gives the frames of the coordinator.
#include "monarch_flight/viz/urdf.h"

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <tf2/buffer_core.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <regex>

#include "monarch_flight/ros_io/flight_messages.h"
#include "monarch_flight/ros_io/model_folder.h"
#include "monarch_flight/ros_io/run_parameters.h"
#include "monarch_flight/viz/frames.h"
#include "monarch_flight/viz/mesh.h"
#include "ros/process.h"

namespace monarch_flight {
namespace {

Case climb() { return loadCase("climb_printed", {{"fluid", "quasi_steady"}}, CONFIG_DIR); }

/// Numbers of a text by position, and the text without them.
std::pair<std::vector<double>, std::string> numbersOf(const std::string& text) {
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?(e[-+][0-9]+)?");
  std::vector<double> values;
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i) {
    values.push_back(std::stod(i->str()));
  }
  return {values, std::regex_replace(text, number, "#")};
}

/// The floats of a binary STL file: normal and corners of every triangle.
std::vector<float> floatsOf(const std::string& bytes) {
  std::vector<float> values;
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    float triangle[12];
    std::memcpy(triangle, &bytes[at], sizeof triangle);
    values.insert(values.end(), triangle, triangle + 12);
  }
  return values;
}

// The last digits are those of the compiler's options.
TEST(Urdf, TheShippedOneIsThatOfThePaperPreset) {
  const Case c = climb();
  TemporaryFolder folder;
  writeMeshes(c.insect, folder / "meshes");
  const auto [ours, text] =
      numbersOf(insectUrdf(c.insect, "package://monarch_flight/urdf/meshes/"));
  const auto [shipped, shipped_text] = numbersOf(fileText(std::string(URDF_DIR) + "/monarch.urdf"));
  EXPECT_EQ(text, shipped_text);
  ASSERT_EQ(ours.size(), shipped.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    EXPECT_NEAR(ours[i], shipped[i], 1e-12 * std::abs(shipped[i])) << "number " << i;
  }
  for (const char* mesh : {"right_wing.stl", "left_wing.stl", "thorax.stl", "abdomen.stl"}) {
    const auto mine = floatsOf(fileText(folder / (std::string("meshes/") + mesh)));
    const auto theirs = floatsOf(fileText(std::string(URDF_DIR) + "/meshes/" + mesh));
    ASSERT_EQ(mine.size(), theirs.size()) << mesh;
    for (std::size_t i = 0; i < mine.size(); ++i) EXPECT_NEAR(mine[i], theirs[i], 1e-6f) << mesh;
  }
}

TEST(Mesh, TheWingHasItsAreaOnBothSides) {
  const Planform planform = Planform::ellipse(0.02, 0.05, 0.25);
  for (bool left : {false, true}) {
    double area = 0.0;
    for (const auto& t : wingMesh(planform, left, 400).triangles) {
      area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
      for (const auto& p : t) {
        EXPECT_EQ(0.0f, p.z());
        EXPECT_LE((left ? -p.y() : p.y()), 0.05f * 1.0001f);
        EXPECT_GE((left ? -p.y() : p.y()), 0.0f);
      }
    }
    EXPECT_NEAR(2.0 * planform.area(), area, 1e-4 * area);
  }
}

TEST(Mesh, TheEllipsoidIsClosedAndFacesOutwards) {
  const Mesh mesh = ellipsoidMesh({1, 2, 3}, 4.0, 2.0);
  Eigen::Vector3f closed = Eigen::Vector3f::Zero();
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    closed += (t[1] - t[0]).cross(t[2] - t[0]);
    const Eigen::Vector3f c(1, 2, 3);
    volume += (t[0] - c).dot((t[1] - c).cross(t[2] - c)) / 6.0;
  }
  EXPECT_LT(closed.norm(), 1e-4f);
  EXPECT_NEAR(M_PI / 6.0 * 4.0 * 4.0, volume, 0.04 * volume);
}

Eigen::Isometry3d isometry(const geometry_msgs::TransformStamped& stamped) {
  const auto& t = stamped.transform;
  const Eigen::Quaterniond q(t.rotation.w, t.rotation.x, t.rotation.y, t.rotation.z);
  return Eigen::Translation3d(t.translation.x, t.translation.y, t.translation.z) * q;
}

TEST(Urdf, MovesLikeTheFrames) {
  const Case c = climb();
  ros::param::set("/robot_description", insectUrdf(c.insect, "package://monarch_flight/urdf/"));
  ros::param::set("/robot_state_publisher/publish_frequency", 1e6);
  TemporaryFolder folder;
  Process publisher("/usr/lib/robot_state_publisher/robot_state_publisher", {}, folder / "rsp.log");
  ros::NodeHandle node;
  tf2::BufferCore buffer(ros::Duration(1000.0));
  const auto keep = [&buffer](const tf2_msgs::TFMessageConstPtr& message, bool fixed) {
    for (const auto& t : message->transforms) buffer.setTransform(t, "rsp", fixed);
  };
  const ros::Subscriber moving = node.subscribe<tf2_msgs::TFMessage>(
      "/tf", 100, [&keep](const tf2_msgs::TFMessageConstPtr& m) { keep(m, false); });
  const ros::Subscriber fixed = node.subscribe<tf2_msgs::TFMessage>(
      "/tf_static", 100, [&keep](const tf2_msgs::TFMessageConstPtr& m) { keep(m, true); });
  const ros::Publisher joint_states = node.advertise<sensor_msgs::JointState>("/joint_states", 8);
  for (int i = 0; i < 1000 && (joint_states.getNumSubscribers() == 0 ||
                               moving.getNumPublishers() == 0 || fixed.getNumPublishers() == 0);
       ++i) {
    ros::WallDuration(0.01).sleep();
  }
  ASSERT_GT(joint_states.getNumSubscribers(), 0u) << publisher.output();
  ros::WallDuration(0.5).sleep();

  FlightMessages messages(c);
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> angle(-1.2, 1.2);
  for (std::uint32_t i = 1; i <= 20; ++i) {
    CommittedStep step;
    step.step = i;
    for (Side side : kSides) {  // each wing goes its own way
      step.angles.wings[side] = {
          {angle(generator), 0, 0}, {angle(generator), 0, 0}, {angle(generator), 0, 0}};
    }
    step.angles.theta_A.q = angle(generator);
    for (const StampedMessage& m : messages.of(step)) {
      const auto* joints = std::get_if<sensor_msgs::JointState>(&m.message);
      if (joints != nullptr) joint_states.publish(*joints);
    }
    const ros::Time stamp = stampOf(i, c.time);
    for (int k = 0; k < 500 && !buffer.canTransform("base_link", "abdomen", stamp); ++k) {
      ros::WallDuration(0.01).sleep();
      ros::spinOnce();
    }
    tf2::BufferCore ours;
    for (const auto& t : staticTransforms(c.insect, stamp)) ours.setTransform(t, "test", true);
    for (const auto& t : movingTransforms(c.insect, {}, step.angles, stamp)) {
      ours.setTransform(t, "test", false);
    }
    for (const char* frame :
         {"body_frd", "stroke_plane", "right_wing_flapping", "right_wing_deviation", "right_wing",
          "left_wing_flapping", "left_wing_deviation", "left_wing", "abdomen"}) {
      ASSERT_TRUE(buffer.canTransform("base_link", frame, stamp)) << frame;
      const Eigen::Isometry3d theirs = isometry(buffer.lookupTransform("base_link", frame, stamp)),
                              mine = isometry(ours.lookupTransform("base_link", frame, stamp));
      EXPECT_LT((theirs.matrix() - mine.matrix()).norm(), 1e-12) << frame;
    }
  }
}

/// A folder below another one, last used so many days ago, with a file in it.
std::filesystem::path usedBefore(const std::filesystem::path& folder, int days,
                                 const std::string& file) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / file) << "x";
  std::filesystem::last_write_time(
      folder, std::filesystem::file_time_type::clock::now() - std::chrono::hours(24 * days));
  return folder;
}

TEST(Urdf, ModelsThatNobodyUsesAnyMoreAreRemoved) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const fs::path home = folder / "home", place = home / "monarch_flight";
  const fs::path old = usedBefore(place / "model-a-0123456789ab", 31, "right_wing.stl"),
                 used = usedBefore(place / "model-b-0123456789ab", 29, "right_wing.stl"),
                 precious = usedBefore(place / "model-c-0123456789ab", 31, "precious.txt"),
                 others = usedBefore(place / "mine", 31, "right_wing.stl"),
                 mine = usedBefore(place / "model-mine", 31, "right_wing.stl"),
                 elsewhere = usedBefore(folder / "model-d-0123456789ab", 31, "right_wing.stl");
  fs::create_directory_symlink(elsewhere, place / "model-e-0123456789ab");
  const auto token = [&place](const std::string& name, int days,
                              const char* secret = "of one run: 0123456789abcdef") {
    std::ofstream(place / name) << secret << '\n';
    fs::last_write_time(place / name,
                        fs::file_time_type::clock::now() - std::chrono::hours(24 * days));
    return place / name;
  };
  const fs::path killed = token("token_a_1", 31), running = token("token_a_2", 0),
                 own = token("token_of_mine", 31, "0123456789abcdef0123456789abcdef");
  const fs::path again = keptModel(climb(), home);
  EXPECT_TRUE(fs::exists(again / "left_wing.stl"));
  EXPECT_FALSE(fs::exists(old));
  EXPECT_FALSE(fs::exists(killed));
  for (const fs::path& kept :
       {used / "right_wing.stl", precious / "precious.txt", others / "right_wing.stl",
        mine / "right_wing.stl", elsewhere / "right_wing.stl", running, own})
    EXPECT_TRUE(fs::exists(kept)) << kept;
  // One that is used again is as good as new.
  fs::last_write_time(again, fs::file_time_type::clock::now() - std::chrono::hours(24 * 31));
  EXPECT_EQ(again, fs::path(keptModel(climb(), home)));
  EXPECT_TRUE(fs::exists(again / "left_wing.stl"));
}

}  // namespace
}  // namespace monarch_flight
