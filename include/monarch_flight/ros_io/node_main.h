#pragma once
#include <functional>
#include <memory>
#include <string>

#include "monarch_flight/coupling/guidance.h"
#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/coupling/stop_flag.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// Exit codes of all executables.
enum ExitCode { kExitComplete = 0, kExitFailed = 1, kExitInput = 2, kExitInterrupted = 130 };

/// True once SIGINT or SIGTERM has come; set by the handlers that the mains below install.
const StopFlag& stopRequested();

/// Mains of the executables: read, check, wire, run; return the exit code and print every failure
/// as one message on stderr.
int coordinatorMain(int argc, char** argv);
int participantMain(Role role, int argc, char** argv);
/// participantMain of the fluid on the processes that mpirun started; process 0 speaks ROS.
int fluidMain(int argc, char** argv);
/// Main of a guidance node of one's own (docs/guidance.md): serves one run with what `make` returns
/// for the run's case.
int guidanceMain(int argc, char** argv,
                 const std::function<std::unique_ptr<Guidance>(const Case&)>& make);
/// Main of the viewer of the flow for rviz (FlowView), until it is stopped.
int flowViewMain(int argc, char** argv);
/// The same flight without a master: key:=value arguments.
int inProcessMain(int argc, char** argv);
/// Prints the URDF of a case's insect and writes its meshes: `case:=<name or path>`,
/// `out:=<folder>` (default: `~/.ros/monarch_flight/model-<case>`), `mesh_uri:=<where the URDF
/// finds them>` (default: out).
int insectModelMain(int argc, char** argv);

}  // namespace monarch_flight
