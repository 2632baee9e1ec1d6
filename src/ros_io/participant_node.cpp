#include "monarch_flight/ros_io/participant_node.h"

#include "monarch_flight/ros_io/flight_messages.h"
#include "monarch_flight/ros_io/master.h"
#include "monarch_flight/ros_io/node_main.h"
#include "monarch_flight/run/federation.h"

namespace monarch_flight {
namespace {

Case readCase(Role role) {
  XmlRpc::XmlRpcValue values = parametersOf(kNamespace);
  const RunParameters parameters = runParameters(values, std::string(kNamespace) + "/");
  const Case c = loadCase(parameters);
  if (role == Role::kFluid) requireProcesses(parameters, c);
  return c;
}

}  // namespace

Reply ParticipantOnStart::exchange(const Request& request) {
  if (request.key.phase == Phase::kStart) participant_ = makeParticipant(role_, case_);
  if (participant_) return participant_->exchange(request);
  Reply reply;
  reply.key = request.key;
  if (request.key.phase != Phase::kAbort) reply.error = "no START before the first request";
  return reply;
}

ParticipantNode::ParticipantNode(Role role, const StopFlag& stop)
    : case_(readCase(role)),
      participant_(role, case_),
      server_(ros::NodeHandle(kNamespace), {role, case_.name, case_.sha256}, participant_,
              limitsFor(case_.watchdog_s), stop) {}

int ParticipantNode::run() {
  server_.serve();
  if (server_.counters().any()) {
    ROS_INFO("requests that were ignored: %s", server_.counters().describe().c_str());
  }
  return kExitComplete;
}

}  // namespace monarch_flight
