#pragma once

namespace monarch_flight {

/// Nodes can be reached from their own machine only, unless the person has given them an address
/// (ROS_IP or ROS_HOSTNAME), as a run on several machines needs it. Call before ros::init.
void preferLoopback();

/// ros::start with every port that it opens bound to the loopback address, if that is the node's
/// address: roscpp itself binds its XML-RPC server (by which a node can be shut down) to all
/// addresses of the machine, whatever ROS_HOSTNAME says.
void startOnLoopback();

}  // namespace monarch_flight
