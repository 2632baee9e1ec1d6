#include "monarch_flight/ros_io/node_main.h"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <random>

#include "monarch_flight/fluid/processes.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/coordinator_node.h"
#include "monarch_flight/ros_io/early_end.h"
#include "monarch_flight/ros_io/flight_run.h"
#include "monarch_flight/ros_io/flow_view.h"
#include "monarch_flight/ros_io/loopback.h"
#include "monarch_flight/ros_io/master.h"
#include "monarch_flight/ros_io/model_folder.h"
#include "monarch_flight/ros_io/participant_node.h"
#include "monarch_flight/ros_io/pluginlib_source.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/plugins.h"
#include "monarch_flight/run/remarks.h"
#include "monarch_flight/viz/urdf.h"

namespace monarch_flight {
namespace {

// A master that goes while nodes register with it is asked again for so long; roscpp's own limit is
// none.
const ros::WallDuration kMasterPatience(10.0);

StopFlag stop_requested{false};

void requestStop(int) { stop_requested = true; }

// By whoever has started this: nohup, a shell that puts it into its background.
bool ignored(int number) {
  struct sigaction now {};
  return sigaction(number, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

// Runs `body`; what it throws becomes a message and an exit code.
int guarded(const std::string& name, const std::function<int()>& body) {
  usePluginlib();
  for (int stop : {SIGINT, SIGTERM, SIGHUP})  // the last one: the terminal was closed
    if (!ignored(stop)) std::signal(stop, requestStop);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is met like a full disk: with a message
  const auto tell = [&name](const char* what) { std::cerr << name << ": " << what << std::endl; };
  try {
    return body();
  } catch (const InputError& e) {
    tell(e.what());
    return kExitInput;
  } catch (const std::exception& e) {
    tell(e.what());
    return stop_requested ? kExitInterrupted : kExitFailed;
  }
}

// Takes leave of the master, however the node ends.
struct Farewell {
  ~Farewell() { ros::shutdown(); }
};

int nodeMain(const std::string& name, int argc, char** argv, const std::function<int()>& body) {
  return guarded(name, [&] {
    // Namespace of the package unless the launcher gives another.
    if (std::getenv("ROS_NAMESPACE") == nullptr)
      setenv("ROS_NAMESPACE", RunNames().space().c_str(), 1);
    const bool alone = preferLoopback();
    ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
    requireFreeMaster();
    ros::master::setRetryTimeout(kMasterPatience);
    const Farewell farewell;
    startOnLoopback();
    if (alone && name == "coordinator")
      std::cout << "nodes can be reached from this machine only; for several machines set "
                   "ROS_HOSTNAME or ROS_IP on each before anything of ROS starts there "
                   "(docs/usage.md, another machine)"
                << std::endl;
    try {
      return body();
    } catch (const std::exception& e) {
      tellEarlyEnd(dynamic_cast<const InputError*>(&e) != nullptr ? kExitInput : kExitFailed);
      tellRosout(name + ": " + e.what());
      throw;
    }
  });
}

// A process of the flow other than the first leaves when that one says so, not by a signal: the
// first still writes a checkpoint, to which all contribute.
int serveFlow(const Processes& processes) {
  for (int stop : {SIGINT, SIGTERM, SIGHUP}) std::signal(stop, SIG_IGN);
  processes.serveFlow();
  return kExitComplete;
}

// key:=auto and key:= are what launch files have for an argument that is not given.
bool given(const std::string& argument) {
  const std::size_t mark = argument.find(":=");
  if (mark == std::string::npos) return true;
  const std::string value = argument.substr(mark + 2);
  return !value.empty() && value != "auto";
}

}  // namespace

const StopFlag& stopRequested() { return stop_requested; }

int coordinatorMain(int argc, char** argv) {
  return nodeMain("coordinator", argc, argv, [] { return CoordinatorNode(stop_requested).run(); });
}

int fluidMain(int argc, char** argv) {
  const Processes processes(&argc, &argv);
  if (processes.rank() > 0) return serveFlow(processes);
  // One program for both wings: its name says which.
  bool left = false;
  for (int i = 1; i < argc; ++i)
    left = left || std::string(argv[i]) == std::string("__name:=") + roleName(Role::kFluidLeft);
  return participantMain(left ? Role::kFluidLeft : Role::kFluid, argc, argv);
}

int participantMain(Role role, int argc, char** argv) {
  return nodeMain(roleName(role), argc, argv,
                  [role] { return ParticipantNode(role, stop_requested).run(); });
}

int guidanceMain(int argc, char** argv,
                 const std::function<std::unique_ptr<Guidance>(const Case&)>& make) {
  return nodeMain(roleName(Role::kGuidance), argc, argv,
                  [&make] { return ParticipantNode(stop_requested, make).run(); });
}

int flowViewMain(int argc, char** argv) {
  return nodeMain("flow_view", argc, argv, [] {
    const FlowView view;
    while (ros::ok() && !stop_requested)
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    return static_cast<int>(kExitComplete);
  });
}

int inProcessMain(int argc, char** argv) {
  const Processes processes(&argc, &argv);
  if (processes.rank() > 0) return serveFlow(processes);
  return guarded("fly_in_process", [&] {
    const RunParameters parameters = runParameters(argc, argv);
    setFlowThreads(parameters.threads);
    if (parameters.paused) throw InputError("paused = true: only a run of nodes can be held");
    const Case c = loadCase(parameters);
    requirePlugins(c);
    if (parameters.plan) {
      const std::string plan = plannedRun(parameters, c, false);
      std::cout << "air: " << fluidName(c) << "; wingbeat led by: " << guidanceName(c.guidance)
                << '\n'
                << (plan.empty() ? "this air has no grid to plan\n" : plan);
      for (const std::string& remark : runRemarks(c, c.time.steps))
        std::cout << remark << std::endl;
      return static_cast<int>(kExitComplete);
    }
    if (c.guidance.kind == GuidanceKind::kNode || c.guidance.kind == GuidanceKind::kCommands)
      throw InputError(
          std::string("guidance/type = ") + guidanceName(c.guidance.kind) +
          ": a run in one process has no nodes and no topics that could lead it; choose "
          "another type, or fly with nodes (in_process:=false)");
    requireProcesses(parameters, c);
    if (parameters.ranks > 1 && !c.mirrored)
      throw InputError(
          "ranks = " + std::to_string(parameters.ranks) +
          ": in one process the flows of two wings run on one MPI process; use ranks:=1, "
          "or fly with nodes (in_process:=false)");
    const std::string out = outputDirectory(parameters, c);
    std::cout << plannedRun(parameters, c, false);
    FlightRun run(c, out, !parameters.resume.empty(), parameters.ranks);
    InProcessFederation federation(c, checkpointFolder(out));
    FlyUntil control(stop_requested);
    return run.fly(1, federation.participants(), control, stop_requested);
  });
}

int insectModelMain(int argc, char** argv) {
  return guarded("insect_model", [&] {
    std::string uri;
    std::vector<char*> others;
    for (int i = 0; i < argc; ++i) {
      const std::string argument = argv[i];
      if (argument.rfind("mesh_uri:=", 0) == 0) {
        uri = argument.substr(10);
      } else if (given(argument)) {
        others.push_back(argv[i]);
      }
    }
    const RunParameters parameters = runParameters(static_cast<int>(others.size()), others.data());
    const Case c = loadCase(parameters);
    std::string folder;
    if (parameters.out.empty()) {
      folder = keptModel(c, rosHome());
    } else {
      folder = outputDirectory(parameters, c);
      writeMeshes(c.insect, folder);
    }
    if (uri.empty()) uri = "file://" + folder + "/";
    std::cout << insectUrdf(c.insect, uri);
    return static_cast<int>(kExitComplete);
  });
}

}  // namespace monarch_flight
