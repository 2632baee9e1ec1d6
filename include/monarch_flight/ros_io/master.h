#pragma once
#include <XmlRpcValue.h>

#include <string>

#include "monarch_flight/ros_io/run_names.h"

namespace monarch_flight {

/// Preconditions of a node, asked from the master before the node registers (registering would make
/// the master shut down an older node of the same name). Call after ros::init. Throws InputError:
/// no master answers; a living node already has this node's name (a second run).
void requireFreeMaster();

/// The parameters of a namespace as the master holds them; an invalid value when there are none.
XmlRpc::XmlRpcValue parametersOf(const std::string& name);
/// Those of a run. Throws InputError where its namespace holds none: a node must not fly another
/// run than the one it was started for.
XmlRpc::XmlRpcValue parametersOfRun(const RunNames& names);

/// The living node that was the first to advertise a topic; empty: none does.
std::string firstPublisher(const std::string& topic);

/// Whether a node has subscribed to a topic whose name begins with `space`.
bool listens(const std::string& node, const std::string& space);

/// Tells /rosout, which rqt_console and a log on another machine hear, beside the terminal.
void tellRosout(const std::string& text);

}  // namespace monarch_flight
