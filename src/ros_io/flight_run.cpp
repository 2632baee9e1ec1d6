#include "monarch_flight/ros_io/flight_run.h"

#include <unistd.h>

#include <iostream>

#include "monarch_flight/fields/field_output.h"
#include "monarch_flight/ros_io/node_main.h"
#include "monarch_flight/run/federation.h"

namespace monarch_flight {

FlightRun::FlightRun(const Case& c, const std::string& out, std::vector<MessageOutput*> listeners)
    : case_(c),
      fields_(c.output.fields_every > 0 ? makeFieldOutput(c, out + "/fields") : nullptr),
      files_(c, out),
      progress_(std::cout, isatty(STDOUT_FILENO) != 0, c.time) {
  if (c.output.record) {
    bag_ = std::make_unique<BagOutput>(files_.directory().file("flight.bag"));
    listeners.push_back(bag_.get());
  }
  if (!listeners.empty()) messages_ = std::make_unique<MessageSink>(c, listeners);
  std::cout << "case " << c.name << ": " << c.time.steps << " steps of " << c.time.dt
            << " s; results in " << out << std::endl;
}

int FlightRun::fly(std::uint64_t run_id, Participant& fluid, Participant& flight, Participant& wing,
                   RunControl& control, const StopFlag& stop) {
  std::vector<StepSink*> sinks = {&progress_};
  if (messages_) sinks.push_back(messages_.get());
  if (fields_) sinks.push_back(fields_.get());
  sinks.push_back(&files_);  // the summary knows of the failures of those before it
  sinks.insert(sinks.end(), last_.begin(), last_.end());
  const RunResult result = runCase(case_, run_id, fluid, flight, wing, sinks, control);
  if (result.complete) {
    std::cout << "flight complete: " << files_.directory().path() << std::endl;
    return kExitComplete;
  }
  std::cerr << "flight failed: " << result.failure << std::endl;
  return stop ? kExitInterrupted : kExitFailed;
}

}  // namespace monarch_flight
