#include "monarch_flight/ros_io/flight_run.h"

#include <unistd.h>

#include <iostream>

#include "monarch_flight/ros_io/node_main.h"
#include "monarch_flight/run/federation.h"

namespace monarch_flight {

FlightRun::FlightRun(const Case& c, const std::string& out, std::vector<MessageOutput*> listeners)
    : case_(c), files_(c, out), progress_(std::cout, isatty(STDOUT_FILENO) != 0, c.time) {
  if (c.output.record) {
    bag_ = std::make_unique<BagOutput>(files_.directory().file("flight.bag"));
    listeners.push_back(bag_.get());
  }
  if (!listeners.empty()) messages_ = std::make_unique<MessageSink>(c, listeners);
  std::cout << "case " << c.name << ": " << c.time.steps << " steps of " << c.time.dt
            << " s; results in " << out << std::endl;
}

int FlightRun::fly(std::uint64_t run_id, Participant& fluid, Participant& flight, Participant& wing,
                   const StopFlag& stop) {
  std::vector<StepSink*> sinks = {&progress_};
  if (messages_) sinks.push_back(messages_.get());
  sinks.push_back(&files_);  // the last: the summary then knows of the failures of the others
  const RunResult result = runCase(case_, run_id, fluid, flight, wing, sinks, stop);
  if (result.complete) {
    std::cout << "flight complete: " << files_.directory().path() << std::endl;
    return kExitComplete;
  }
  std::cerr << "flight failed: " << result.failure << std::endl;
  return stop ? kExitInterrupted : kExitFailed;
}

}  // namespace monarch_flight
