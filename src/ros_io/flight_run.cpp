#include "monarch_flight/ros_io/flight_run.h"

#include <unistd.h>

#include <iostream>

#include "monarch_flight/fields/field_output.h"
#include "monarch_flight/ros_io/node_main.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/remarks.h"

namespace monarch_flight {

FlightRun::FlightRun(const Case& c, const std::string& out, bool resume, int ranks,
                     const RunNames& names, std::vector<MessageOutput*> listeners)
    : case_(c),
      checkpoints_(c, out, resume, ranks),
      fields_(c.output.fields_every > 0
                  ? makeFieldOutput(c, out + "/fields", checkpoints_.outputs())
                  : nullptr),
      files_(c, out, &checkpoints_),
      progress_(std::cout, isatty(STDOUT_FILENO) != 0, c.time) {
  openBag(listeners);
  if (!listeners.empty())
    messages_ = std::make_unique<MessageSink>(c, names, listeners, checkpoints_.outputs());
  std::cout << "case " << c.name << ": " << c.time.steps << " steps of " << c.time.dt
            << " s; results in " << out << std::endl;
  for (const std::string& remark : runRemarks(c, c.time.steps)) std::cout << remark << std::endl;
  if (checkpoints_.resumption()) tell();
}

void FlightRun::openBag(std::vector<MessageOutput*>& listeners) {
  const std::string path = files_.directory().file("flight.bag");
  StateVisitor* resumed = checkpoints_.outputs();
  bag_ = resumed ? std::make_unique<BagOutput>(path, *resumed) : std::make_unique<BagOutput>(path);
  if (case_.output.record) {
    listeners.push_back(bag_.get());
    return;
  }
  if (bag_->resumed()) {  // recorded before, but not from here on
    bag_->open({});
    bag_->close();
  }
  bag_.reset();
}

void FlightRun::tell() const {
  const Resumption& resumption = *checkpoints_.resumption();
  for (const std::string& why : resumption.refused)
    std::cout << "checkpoint not used: " << why << std::endl;
  std::cout << "goes on after step " << resumption.step << std::endl;
  for (const std::string& change : resumption.changed)
    std::cout << "changed since then: " << change << std::endl;
}

int FlightRun::fly(std::uint64_t run_id, const Participants& participants, RunControl& control,
                   const StopFlag& stop) {
  std::vector<StepSink*> sinks = {&progress_};
  if (messages_) sinks.push_back(messages_.get());
  if (fields_) sinks.push_back(fields_.get());
  sinks.push_back(&files_);  // the summary knows of the failures of those before it
  sinks.insert(sinks.end(), last_.begin(), last_.end());
  const RunResult result = runCase(case_, run_id, participants, sinks, control, &checkpoints_);
  if (result.complete) {
    std::cout << "flight complete: " << files_.directory().path() << std::endl;
    return kExitComplete;
  }
  failure_ = result.failure;
  std::cerr << "flight failed: " << result.failure << std::endl;
  if (checkpoints_.kept().value_or(0) > 0)  // else it is as good to begin anew
    std::cerr << "it can go on from step " << *checkpoints_.kept() << ": " << checkpoints_.command()
              << std::endl;
  return stop ? kExitInterrupted : kExitFailed;
}

}  // namespace monarch_flight
