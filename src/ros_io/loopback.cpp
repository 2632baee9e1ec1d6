#include "monarch_flight/ros_io/loopback.h"

#include <ros/network.h>
#include <ros/ros.h>

#include <atomic>
#include <cstdlib>

namespace monarch_flight {
namespace {

std::atomic<bool> loopback_only{false};

}  // namespace

bool preferLoopback() {
  if (std::getenv("ROS_IP") != nullptr || std::getenv("ROS_HOSTNAME") != nullptr) return false;
  setenv("ROS_HOSTNAME", "localhost", 1);
  return true;
}

bool loopbackOnly() { return loopback_only; }

void startOnLoopback() {
  const std::string& host = ros::network::getHost();
  loopback_only = host == "localhost" || host.rfind("127.", 0) == 0;
  ros::start();
  loopback_only = false;
}

}  // namespace monarch_flight
