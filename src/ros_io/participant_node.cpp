#include "monarch_flight/ros_io/participant_node.h"

#include <cstdlib>
#include <iostream>
#include <random>
#include <utility>

#include "monarch_flight/fluid/processes.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/early_end.h"
#include "monarch_flight/ros_io/master.h"
#include "monarch_flight/ros_io/node_main.h"
#include "monarch_flight/ros_io/token_file.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/kept_participant.h"
#include "monarch_flight/run/plugins.h"

namespace monarch_flight {
namespace {

/// Parameters and case, which all nodes of a run read: of their faults the coordinator tells.
std::pair<RunParameters, Case> readRun(const RunNames& names) {
  XmlRpc::XmlRpcValue values = parametersOfRun(names);
  try {
    RunParameters parameters = runParameters(values, names.topic(""));
    Case c = loadCase(parameters);
    return {std::move(parameters), std::move(c)};
  } catch (const InputError&) {
    leaveFaultToCoordinator(names.space());
    throw;
  }
}

Case readCase(Role role, const RunNames& names) {
  auto [parameters, c] = readRun(names);
  if (role == Role::kFluid || role == Role::kFluidLeft) {
    requireProcesses(parameters, c);
    setFlowThreads(parameters.threads);
    requireFluidPlugin(c);
  }
  if (role == Role::kFluidLeft && c.mirrored)
    throw InputError(std::string(roleName(role)) +
                     ": this case has mirrored wings, one fluid is enough; leave this node out, or "
                     "fly with wings:=independent");
  if (role == Role::kFluid) {
    std::cout << plannedRun(parameters, c, true) << std::flush;
  }
  return c;
}

// For tests: MONARCH_ANSWER_DELAY_MS delays every answer by a random time up to so many
// milliseconds.
void delayForTest() {
  static const char* const limit = std::getenv("MONARCH_ANSWER_DELAY_MS");
  if (limit == nullptr) return;
  static std::minstd_rand random(std::random_device{}());
  std::uniform_real_distribution<double> milliseconds(0.0, std::atof(limit));
  ros::WallDuration(1e-3 * milliseconds(random)).sleep();
}

Reply refusal(const Request& request, const std::string& why) {
  Reply reply;
  reply.key = request.key;
  if (request.key.phase != Phase::kAbort) reply.error = why;
  return reply;
}

}  // namespace

Reply ParticipantOnStart::exchange(const Request& request) {
  delayForTest();
  if (request.key.phase == Phase::kStart) {
    participant_.reset();  // a reset never holds two flows
    try {
      participant_ = make_(request.checkpoints);
    } catch (const std::exception& e) {
      return refusal(request, e.what());
    }
  }
  if (participant_) return participant_->exchange(request);
  return refusal(request, "no START before the first request");
}

ParticipantNode::ParticipantNode(Role role, const StopFlag& stop)
    : names_(RunNames::ofThisNode()),
      case_(readCase(role, names_)),
      participant_([this, role](const std::string& checkpoints) {
        return makeParticipant(role, case_, checkpoints);
      }),
      server_(ros::NodeHandle(names_.space()),
              {role, case_.name, case_.sha256, tokenOfRun(names_, stop)}, participant_,
              limitsFor(case_.watchdog_s), stop) {}

ParticipantNode::ParticipantNode(const StopFlag& stop,
                                 const std::function<std::unique_ptr<Guidance>(const Case&)>& make)
    : names_(RunNames::ofThisNode()),
      case_(readCase(Role::kGuidance, names_)),
      participant_([this, make](const std::string& checkpoints) {
        return std::make_unique<KeptParticipant>(
            roleName(Role::kGuidance),
            std::make_unique<GuidanceParticipant>(makeModel(case_), make(case_)), checkpoints);
      }),
      server_(ros::NodeHandle(names_.space()),
              {Role::kGuidance, case_.name, case_.sha256, tokenOfRun(names_, stop)}, participant_,
              limitsFor(case_.watchdog_s), stop) {}

int ParticipantNode::run() {
  server_.serve();
  if (server_.counters().total() > 0) {
    ROS_INFO("requests that were ignored: %s", server_.counters().describe().c_str());
  }
  return kExitComplete;
}

}  // namespace monarch_flight
