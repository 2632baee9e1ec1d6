#include "monarch_flight/ros_io/early_end.h"

#include <ros/master.h>
#include <ros/this_node.h>

#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/master.h"
#include "monarch_flight/ros_io/node_main.h"
#include "monarch_flight/ros_io/run_names.h"

namespace monarch_flight {
namespace {

const ros::WallDuration kLook(0.5), kSlice(0.05);
const ros::WallDuration kCoordinatorReads(5.0);  // its case, at the latest

std::string parameterOf(const std::string& space, const std::string& node) {
  return RunNames(space).topic(std::string(kExitCodesKey) + "/" + node);
}

/// Negative where it is not known.
int exitCode(const std::string& parameter) {
  XmlRpc::XmlRpcValue value = parametersOf(parameter);
  return value.getType() == XmlRpc::XmlRpcValue::TypeInt ? static_cast<int>(value) : -1;
}

}  // namespace

void tellEarlyEnd(int exit_code) {
  const std::string& node = ros::this_node::getName();
  const std::string parameter =
      parameterOf(ros::this_node::getNamespace(), node.substr(node.rfind('/') + 1));
  if (!parametersOf(parameter).valid()) return;
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = node;
  request[1] = parameter;
  request[2] = exit_code;
  ros::master::execute("setParam", request, response, payload, false);
}

EarlyEnd::EarlyEnd(const std::string& space, const std::string& node, const std::string& what)
    : parameter_(parameterOf(space, node)), what_(what) {}

void EarlyEnd::refuse() {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (now < next_) return;
  next_ = now + kLook;
  const int code = exitCode(parameter_);
  if (code == kExitInput)
    throw InputError(what_ + " has refused the run; the reason is its own message");
  if (code >= 0)
    throw ExchangeError(what_ + " has ended before the flight; the reason is its own message");
}

void leaveFaultToCoordinator(const std::string& space) {
  if (!parametersOf(parameterOf(space, "coordinator")).valid()) return;
  EarlyEnd coordinator(space, "coordinator", "the coordinator");
  const ros::SteadyTime deadline = ros::SteadyTime::now() + kCoordinatorReads;
  while (!stopRequested() && ros::SteadyTime::now() < deadline) {
    try {
      coordinator.refuse();
    } catch (const ExchangeError&) {
      return;
    }
    kSlice.sleep();
  }
}

}  // namespace monarch_flight
