#include "monarch_flight/ros_io/coordinator_node.h"

#include <random>

#include "monarch_flight/fluid/processes.h"
#include "monarch_flight/guidance/command_remarks.h"
#include "monarch_flight/ros_io/conversions.h"
#include "monarch_flight/ros_io/early_end.h"
#include "monarch_flight/ros_io/flight_control.h"
#include "monarch_flight/ros_io/flight_run.h"
#include "monarch_flight/ros_io/guidance_by_node.h"
#include "monarch_flight/ros_io/master.h"
#include "monarch_flight/ros_io/node_main.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/plugins.h"

namespace monarch_flight {
namespace {

const ros::WallDuration kHeldWait(0.01);  // of a held run, for messages; then it looks for orders
constexpr std::uint32_t kCommandQueue = 100;

/// The nodes that a run needs.
std::vector<Role> nodesOf(const Case& c) {
  std::vector<Role> roles;
  for (Role role : rolesOf(c)) {
    if (role != Role::kGuidance || c.guidance.kind == GuidanceKind::kNode) roles.push_back(role);
  }
  return roles;
}

std::uint64_t randomRunId() {
  std::random_device random;
  return (static_cast<std::uint64_t>(random()) << 32 | random()) | 1u;  // never 0
}

RunParameters readParameters(const RunNames& names) {
  XmlRpc::XmlRpcValue values = parametersOfRun(names);
  return runParameters(values, names.topic(""));
}

/// The launch file starts the fluid of the left wing only where it is told of it.
void requireLeftFluid(const RunParameters& parameters, const Case& c, const RunNames& names) {
  const bool by_launch_file = parametersOf(names.topic(kExitCodesKey)).valid();
  if (by_launch_file && !c.mirrored && parameters.overrides.count("wings") == 0)
    throw InputError(
        "wings = independent in the case file, and the launch file knows of one fluid only; "
        "give wings:=independent to roslaunch, too, or fly with monarch fly");
}

}  // namespace

CoordinatorNode::CoordinatorNode(const StopFlag& stop)
    : stop_(stop),
      names_(RunNames::ofThisNode()),
      parameters_(readParameters(names_)),
      case_(loadCase(parameters_)),
      node_(names_.space()),
      token_(names_) {
  requireLeftFluid(parameters_, case_, names_);
  requireGuidancePlugin(case_);
  setFlowThreads(parameters_.threads);  // of the plan
  run_.id = randomRunId();
  run_.limits = limitsFor(case_.watchdog_s);
  run_.stop = &stop_;
  if (token_.token().empty()) {
    ROS_WARN("%s is not set: every node of this master can take part in the run",
             names_.topic(kTokenFileKey).c_str());
  }
  for (Role role : nodesOf(case_)) {
    const LockstepIdentity identity{role, case_.name, case_.sha256, token_.token()};
    nodes_.push_back(std::make_unique<RosParticipant>(node_, identity, run_));
  }
}

int CoordinatorNode::run() {
  try {
    for (const auto& participant : nodes_) participant->connect();
    token_.remove();
    const int code = fly();
    reportIgnored();
    ros::WallDuration(0.2).sleep();  // the last messages are still on their way to the listeners
    return code;
  } catch (...) {
    dismiss();
    throw;
  }
}

int CoordinatorNode::fly() {
  topics_ = std::make_unique<RosOutput>(node_);
  const std::string out = outputDirectory(parameters_, case_);
  run_.checkpoints = checkpointFolder(out);
  const auto guidance = makeGuidance(run_.checkpoints);
  FlightRun run(case_, out, !parameters_.resume.empty(), parameters_.ranks, names_,
                {topics_.get()});
  FlightControl control(
      node_, names_, case_, parameters_, [this] { keepAlive(); }, stop_);
  run.addSink(control);
  Participants all{};
  for (const auto& node : nodes_) all[static_cast<std::size_t>(node->role())] = node.get();
  all[static_cast<std::size_t>(Role::kGuidance)] = guidance.get();
  const int code = run.fly(run_.id, all, control, stop_);
  if (code != kExitComplete) tellRosout("flight failed: " + run.failure());
  return code;
}

/// In this process, led by the topic `command` or by a node where the case says so.
std::unique_ptr<Participant> CoordinatorNode::makeGuidance(const std::string& checkpoints) {
  const GuidanceKind kind = case_.guidance.kind;
  if (kind == GuidanceKind::kCommands || kind == GuidanceKind::kNode)
    inbox_ = std::make_shared<CommandInbox>(
        [remarks = CommandRemarks(case_.guidance.wingbeat.limits)](const auto& wanted) mutable {
          for (const std::string& remark : remarks.on(wanted)) ROS_WARN("%s", remark.c_str());
        });
  auto own = makeParticipant(Role::kGuidance, case_, checkpoints, inbox_);
  if (kind == GuidanceKind::kNode) {
    own_ = std::move(own);
    for (const auto& node : nodes_) {
      if (node->role() == Role::kGuidance)
        return std::make_unique<GuidanceByNode>(*node, *own_, inbox_);
    }
  }
  auto options = ros::SubscribeOptions::create<WingbeatCommand>(
      "command", kCommandQueue, [this](const WingbeatCommandConstPtr& m) { onCommand(m); },
      ros::VoidConstPtr(), &run_.queue);
  commands_ = node_.subscribe(options);
  return own;
}

/// The queue is looked at while the coordinator waits for the nodes, so commands come between
/// steps.
void CoordinatorNode::onCommand(const WingbeatCommandConstPtr& command) {
  if (inbox_) {
    inbox_->post(fromMessage(*command), command->at_once);
    return;
  }
  ROS_WARN_ONCE(
      "a command came, but nobody may lead this flight: guidance/type must be commands "
      "(guidance:=commands)");
}

void CoordinatorNode::keepAlive() {
  run_.queue.callAvailable(kHeldWait);
  nodes_[0]->requireEveryone(" while the run is held");
  nodes_[0]->greetEveryone();
  topics_->keepAlive();
}

void CoordinatorNode::dismiss() noexcept {
  for (const auto& participant : nodes_) {
    try {
      Request farewell;
      farewell.key.run = run_.id;
      farewell.key.phase = Phase::kAbort;
      if (participant->connected()) participant->exchange(farewell);
    } catch (const std::exception&) {  // gone already
    }
  }
}

void CoordinatorNode::reportIgnored() const {
  for (const auto& participant : nodes_) {
    const IgnoredMessages counters = participant->ignored();
    if (counters.total() > 0) {
      ROS_INFO("messages of %s that were ignored: %s", participant->name().c_str(),
               counters.describe().c_str());
    }
  }
}

}  // namespace monarch_flight
