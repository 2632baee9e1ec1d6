#pragma once
#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/coupling/coordinator.h"
#include "monarch_flight/coupling/run_control.h"
#include "monarch_flight/ros_io/bag_output.h"
#include "monarch_flight/ros_io/flight_messages.h"
#include "monarch_flight/run/progress.h"
#include "monarch_flight/run/run_outputs.h"

namespace monarch_flight {

/// One flight with everything it writes and shows: files, bag (when recorded), topics, progress
/// bar. The same for the coordinator node and for a run in one process.
class FlightRun {
 public:
  /// Makes the folder `out`, or goes on from the newest checkpoint in it (`resume`) and says from
  /// which. `ranks`: processes of the flow. `names`: of the messages, which `listeners` get, too.
  /// Throws InputError, OutputError.
  FlightRun(const Case& c, const std::string& out, bool resume, int ranks,
            const RunNames& names = RunNames(), std::vector<MessageOutput*> listeners = {});
  /// Delivers to `sink`, too, after everything is written; it must outlive this.
  void addSink(StepSink& sink) { last_.push_back(&sink); }
  /// Flies as `control` says; prints the end; returns an exit code (`stop`: stopped by hand).
  int fly(std::uint64_t run_id, const Participants& participants, RunControl& control,
          const StopFlag& stop);
  /// Why it failed; empty: it has not.
  const std::string& failure() const { return failure_; }

 private:
  void tell() const;
  void openBag(std::vector<MessageOutput*>& listeners);

  const Case& case_;
  Checkpoints checkpoints_;
  std::unique_ptr<StepSink> fields_;  // before the folder: a build without VTK refuses
  RunOutputs files_;
  std::unique_ptr<BagOutput> bag_;
  std::unique_ptr<MessageSink> messages_;
  ProgressSink progress_;
  std::vector<StepSink*> last_;
  std::string failure_;
};

}  // namespace monarch_flight
