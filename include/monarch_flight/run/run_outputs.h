#pragma once
#include <string>

#include "monarch_flight/run/checkpoints.h"
#include "monarch_flight/run/csv_tables.h"
#include "monarch_flight/run/run_directory.h"
#include "monarch_flight/run/summary.h"

namespace monarch_flight {

/// The files of a run: case.yaml at once, a row of flight.csv and the rows of iterations.csv at
/// every step, summary.json at the end. The tables are called `*.active` while they grow and get
/// their names at the end, after a failed run too; a table that could not be written keeps its
/// active name. Give it to runCase behind the other sinks: the summary then knows of their
/// failures.
class RunOutputs : public StepSink {
 public:
  /// Makes the folder. Throws InputError (see RunDirectory) and OutputError.
  RunOutputs(const Case& c, const std::string& directory);
  /// The same, or goes on from the checkpoint that `checkpoints` has chosen: the tables are cut to
  /// its length. Throws CheckpointError too.
  RunOutputs(const Case& c, const std::string& directory, Checkpoints& checkpoints);

  /// Throws OutputError, which ends the run.
  void onStep(const CommittedStep& step) override;
  /// Throws OutputError when a file could not be finished; all others are finished nevertheless.
  void onEnd(const std::string& failure) override;
  /// Throws OutputError.
  void onCheckpoint(StateVisitor& state) override;

  const RunDirectory& directory() const { return directory_; }

 private:
  RunOutputs(const Case& c, const std::string& directory, StateVisitor* resumed);

  RunDirectory directory_;
  FlightTable flight_;
  IterationTable iterations_;
  Summary summary_;
};

}  // namespace monarch_flight
