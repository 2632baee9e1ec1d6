#pragma once
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sys/stat.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ros/process.h"

namespace monarch_flight {

constexpr char kTestToken[] = "token of the tests";

/// Parameters on the master and the nodes.
class Nodes : public testing::Test {
 protected:
  Nodes() {
    const std::string token = folder / "token";
    std::ofstream(token) << kTestToken << "\n";
    chmod(token.c_str(), 0600);
    ros::param::del("/monarch_flight");
    ros::param::set("/monarch_flight/token_file", token);
    ros::param::set("/monarch_flight/case", "climb_printed");
    ros::param::set("/monarch_flight/fluid", "quasi_steady");
    ros::param::set("/monarch_flight/flaps", 0.1);
    ros::param::set("/monarch_flight/out", folder / "run");
  }
  std::unique_ptr<Process> start(const std::string& name, const std::string& log = "",
                                 const std::vector<std::string>& arguments = {}) {
    const std::string file = folder / ((log.empty() ? name : log) + ".log");
    return std::make_unique<Process>(std::string(NODE_DIR) + "/" + name, arguments, file);
  }
  void startAll() {
    coordinator = start("coordinator");
    fluid = start("fluid");
    flight = start("flight");
    wing = start("wing");
  }
  // A flight that is long enough to be disturbed, and has begun.
  void startLongFlight() {
    ros::param::set("/monarch_flight/flaps", 50);
    startAll();
    ASSERT_TRUE(coordinator->prints("results in", 20.0)) << coordinator->output();
    ros::WallDuration(0.5).sleep();
    ASSERT_TRUE(coordinator->running()) << coordinator->output();
  }
  nlohmann::json summary(const std::string& run = "run") {
    return nlohmann::json::parse(fileText(folder / (run + "/summary.json")));
  }
  static bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  TemporaryFolder folder;
  std::unique_ptr<Process> coordinator, fluid, fluid_left, flight, wing, guidance;
};

}  // namespace monarch_flight
