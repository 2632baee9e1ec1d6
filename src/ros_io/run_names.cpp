#include "monarch_flight/ros_io/run_names.h"

#include <ros/this_node.h>

#include "monarch_flight/ros_io/master.h"
#include "monarch_flight/viz/frames.h"

namespace monarch_flight {
namespace {

constexpr char kOwn[] = "/monarch_flight";  // last part of a namespace that the launch files make

/// What the package's own namespace lies in; another namespace stands for itself. No slash at the
/// end: "" is the root.
std::string besideRun(const std::string& space) {
  const std::size_t size = sizeof kOwn - 1;
  const bool own = space.size() >= size && space.compare(space.size() - size, size, kOwn) == 0;
  if (own) return space.substr(0, space.size() - size);
  return space == "/" ? "" : space;
}

}  // namespace

RunNames::RunNames(const std::string& space, const std::string& frame_prefix)
    : space_(space), frame_prefix_(frame_prefix) {
  if (frame_prefix_.empty()) frame_prefix_ = besideRun(space);
  const std::size_t first = frame_prefix_.find_first_not_of('/');
  frame_prefix_ = first == std::string::npos ? "" : frame_prefix_.substr(first);
  if (!frame_prefix_.empty() && frame_prefix_.back() != '/') frame_prefix_ += '/';
}

RunNames RunNames::ofThisNode() {
  const std::string& space = ros::this_node::getNamespace();
  XmlRpc::XmlRpcValue prefix = parametersOf(RunNames(space).topic("frame_prefix"));
  const bool given = prefix.getType() == XmlRpc::XmlRpcValue::TypeString;
  const std::string text = given ? static_cast<std::string>(prefix) : "";
  return RunNames(space, text == "auto" ? "" : text);
}

std::string RunNames::topic(const std::string& name) const {
  if (name.rfind("/", 0) == 0) return name;
  if (name.rfind("../", 0) == 0) return besideRun(space_) + name.substr(2);
  return (space_ == "/" ? "" : space_) + "/" + name;
}

std::string RunNames::frame(const std::string& name) const {
  const bool shared = name == frames::kWorld || name == frames::kWorldNed;
  return shared ? name : frame_prefix_ + name;
}

std::string RunNames::diagnosticPrefix() const { return topic("coordinator").substr(1) + ": "; }

}  // namespace monarch_flight
