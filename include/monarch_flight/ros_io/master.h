#pragma once
#include <XmlRpcValue.h>

#include <string>

namespace monarch_flight {

/// Preconditions of a node, asked from the master before the node registers (registering would make
/// the master shut down an older node of the same name). Call after ros::init. Throws InputError:
/// no master answers; a living node already has this node's name (a second run).
void requireFreeMaster();

/// The parameters of a namespace as the master holds them; an invalid value when there are none.
XmlRpc::XmlRpcValue parametersOf(const std::string& name);

}  // namespace monarch_flight
