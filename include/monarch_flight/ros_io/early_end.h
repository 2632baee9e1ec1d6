#pragma once
#include <ros/time.h>

#include <string>

namespace monarch_flight {

/// Parameter of the run's namespace that the launch files make: by node the exit code with which it
/// has ended by a failure, -1 before. Who waits for it in the beginning need not wait until its
/// patience is over.
constexpr char kExitCodesKey[] = "exit_codes";

/// This node ends by a failure. Tells nobody where the parameter is missing (nodes started by
/// hand).
void tellEarlyEnd(int exit_code);

/// Another node of the run, while it is waited for.
class EarlyEnd {
 public:
  /// `space`: the run's; `node`: its name there; `what`: for messages.
  EarlyEnd(const std::string& space, const std::string& node, const std::string& what);
  /// Asks the master, twice a second at most. Throws when the node has ended: InputError where it
  /// has refused its input, else ExchangeError.
  void refuse();

 private:
  std::string parameter_, what_;
  ros::SteadyTime next_;
};

/// This node has found a fault of the run's parameters or case, which the coordinator reads, too:
/// one message is enough. Waits for the coordinator, a few seconds at most, and throws an
/// InputError that points to its message where it has refused the run; returns where it has not, or
/// nobody knows (nodes started by hand).
void leaveFaultToCoordinator(const std::string& space);

}  // namespace monarch_flight
