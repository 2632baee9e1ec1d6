#pragma once
#include <map>
#include <string>

#include "monarch_flight/run/case.h"
#include "monarch_flight/run/config_directory.h"

namespace XmlRpc {
class XmlRpcValue;
}

namespace monarch_flight {

/// What a person may set for a run, on the command line (key:=value) or as ROS parameters of the
/// namespace of the run; an empty text means not given.
struct RunParameters {
  std::string name = "climb_controlled";  ///< `case`: name or path of the case file
  std::string out;                        ///< folder of the results; empty: `flights/<case>-<time>`
  std::string resume;                     ///< folder of a run to go on with; empty: a new run
  std::string directory;  ///< where relative paths start; empty: the working directory
  /// keys of config/keys.yaml that go in place of what the case file says
  CaseOverrides overrides;
  bool plan = false;    ///< `plan`: tell what the run means and end (command line only)
  int threads = 0;      ///< `threads` of each of them; 0: all cores
  int ranks = 1;        ///< `ranks`: processes of the flow solver
  bool paused = false;  ///< `paused`: hold the run at its start (nodes only)
  bool rviz = false;    ///< `rviz`: it was started with the run, which waits for it (nodes only)
  double rate = 0.0;    ///< `rate`: flight time over wall time, at most; 0: no limit (nodes only)
  double watchdog_s = 0.0;  ///< `watchdog` [s]; 0: that of the case
};

/// Checks keys and values by config/keys.yaml. `where` is put before a key in messages
/// ("/monarch_flight/" or ""). Throws InputError with every fault.
RunParameters runParameters(const std::map<std::string, std::string>& values,
                            const std::string& where);
/// Of a command line; arguments of roslaunch (__name:=...) are skipped. Throws InputError.
RunParameters runParameters(int argc, char** argv);
/// Of the struct that the parameter server holds for the namespace `where`; structs in it are
/// private parameters of nodes and left alone. Throws InputError.
RunParameters runParameters(XmlRpc::XmlRpcValue& parameters, const std::string& where);

/// The case that the parameters name, with their overrides. Throws InputError.
Case loadCase(const RunParameters& parameters);
/// Throws InputError unless mpirun started as many processes as `ranks` says (1: without mpirun)
/// and the fluid of the case can use them. For the program that holds the fluid.
void requireProcesses(const RunParameters& parameters, const Case& c);
/// What the run means (RunPlan), for people; with Navier-Stokes air on this machine. Nodes
/// (`nodes`: the fluid is one) and processes of the flow wait for each other no longer than the
/// watchdog. Throws InputError when that cannot be.
std::string plannedRun(const RunParameters& parameters, const Case& c, bool nodes);
/// Where the run writes: absolute path.
std::string outputDirectory(const RunParameters& parameters, const Case& c);

}  // namespace monarch_flight
