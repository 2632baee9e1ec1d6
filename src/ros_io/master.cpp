#include "monarch_flight/ros_io/master.h"

#include <XmlRpcClient.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

// Asks the master; false when it does not answer or says no.
bool ask(const char* method, const std::string& argument, XmlRpc::XmlRpcValue& payload) {
  XmlRpc::XmlRpcValue request, response;
  request[0] = ros::this_node::getName();
  request[1] = argument;
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
    throw InputError("a run is already going on at the master " + ros::master::getURI() +
                     " (node " + name +
                     " lives): wait for its end, or use another port (roslaunch -p)");
  }
}

XmlRpc::XmlRpcValue parametersOf(const std::string& name) {
  XmlRpc::XmlRpcValue payload;
  if (!ask("getParam", name, payload)) return XmlRpc::XmlRpcValue();
  return payload;
}

}  // namespace monarch_flight
