#pragma once

namespace monarch_flight {

/// Nodes can be reached from their own machine only, unless the person has given them an address
/// (ROS_IP or ROS_HOSTNAME), as a run on several machines needs it; true where that is so. Call
/// before ros::init.
bool preferLoopback();

/// ros::start. In the programs of this package, if the node's address is that of the loopback,
/// every port that it opens is bound to it: roscpp itself binds its XML-RPC server (by which a node
/// can be shut down) to all addresses of the machine, whatever ROS_HOSTNAME says.
void startOnLoopback();

/// Whether startOnLoopback is at work and only this machine shall reach what it opens.
bool loopbackOnly();

}  // namespace monarch_flight
