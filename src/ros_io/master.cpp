#include "monarch_flight/ros_io/master.h"

#include <XmlRpcClient.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/node_handle.h>
#include <ros/this_node.h>
#include <rosgraph_msgs/Log.h>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

// Asks the master; false when it does not answer or says no.
bool ask(const char* method, const std::string& argument, XmlRpc::XmlRpcValue& payload) {
  XmlRpc::XmlRpcValue request, response;
  request[0] = ros::this_node::getName();
  if (!argument.empty()) request[1] = argument;
  return ros::master::execute(method, request, response, payload, false);
}

// A node that was killed stays registered; only a living one answers.
bool answers(const std::string& uri) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return false;
  XmlRpc::XmlRpcClient node(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue request, response;
  request[0] = ros::this_node::getName();
  return node.execute("getPid", request, response);
}

}  // namespace

void requireFreeMaster() {
  if (!ros::master::check()) {
    throw InputError("no ROS master answers at " + ros::master::getURI() +
                     ": start the run with roslaunch, start roscore, or use fly_in_process");
  }
  XmlRpc::XmlRpcValue uri;
  const std::string& name = ros::this_node::getName();
  if (ask("lookupNode", name, uri) && answers(uri)) {
    throw InputError(
        "a run is already going on at the master " + ros::master::getURI() + " (node " + name +
        " lives): wait for its end, or use another namespace (ROS_NAMESPACE=b roslaunch "
        "...) or another port (roslaunch -p)");
  }
}

XmlRpc::XmlRpcValue parametersOf(const std::string& name) {
  XmlRpc::XmlRpcValue payload;
  if (!ask("getParam", name, payload)) return XmlRpc::XmlRpcValue();
  return payload;
}

XmlRpc::XmlRpcValue parametersOfRun(const RunNames& names) {
  XmlRpc::XmlRpcValue values = parametersOf(names.space());
  const bool some = values.getType() == XmlRpc::XmlRpcValue::TypeStruct &&
                    (values.hasMember("case") || values.hasMember("resume"));
  if (some) return values;
  throw InputError("there is no run in namespace " + names.space() + " of the master " +
                   ros::master::getURI() + ": " + names.topic("case") +
                   " is not set; start the nodes by a launch file of this package, in the same "
                   "namespace, or set it (a case's name)");
}

std::string firstPublisher(const std::string& topic) {
  XmlRpc::XmlRpcValue state;
  if (!ask("getSystemState", "", state)) return "";
  for (int i = 0; i < state[0].size(); ++i) {  // topic, its publishers in the order they came
    if (static_cast<std::string>(state[0][i][0]) != topic) continue;
    for (int k = 0; k < state[0][i][1].size(); ++k) {
      const std::string node = state[0][i][1][k];
      XmlRpc::XmlRpcValue uri;
      if (node == ros::this_node::getName()) return node;
      if (ask("lookupNode", node, uri) && answers(uri)) return node;
    }
  }
  return "";
}

bool listens(const std::string& node, const std::string& space) {
  XmlRpc::XmlRpcValue state;
  if (!ask("getSystemState", "", state)) return false;
  for (int i = 0; i < state[1].size(); ++i) {  // topic, its subscribers
    if (static_cast<std::string>(state[1][i][0]).rfind(space, 0) != 0) continue;
    for (int k = 0; k < state[1][i][1].size(); ++k)
      if (static_cast<std::string>(state[1][i][1][k]) == node) return true;
  }
  return false;
}

void tellRosout(const std::string& text) {
  if (!ros::isStarted() || !ros::ok()) return;
  ros::NodeHandle node;
  const ros::Publisher rosout = node.advertise<rosgraph_msgs::Log>("/rosout", 10);
  rosgraph_msgs::Log log;
  log.header.stamp = ros::Time::now();
  log.level = rosgraph_msgs::Log::FATAL;
  log.name = ros::this_node::getName();
  log.msg = text;
  rosout.publish(log);
  ros::WallDuration(0.2).sleep();  // it is still on its way
}

}  // namespace monarch_flight
