#pragma once
#include <memory>
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
  /// Makes the folder, or goes on from the checkpoint that `resumed` has chosen: the tables are cut
  /// to its length. Throws InputError (see RunDirectory), OutputError and CheckpointError.
  RunOutputs(const Case& c, const std::string& directory, Checkpoints* resumed = nullptr);

  /// Throws OutputError, which ends the run.
  void onStep(const CommittedStep& step) override;
  /// Files and figures begin anew. Throws OutputError.
  void onReset() override;
  /// Throws OutputError.
  void onCheckpoint(StateVisitor& state) override;
  /// Throws OutputError when a file could not be finished; all others are finished nevertheless.
  void onEnd(const std::string& failure) override;

  const RunDirectory& directory() const { return directory_; }

 private:
  struct Files {
    Files(const Case& c, const RunDirectory& directory, StateVisitor* resumed);
    FlightTable flight;
    IterationTable iterations;
    Summary summary;
  };

  Case case_;
  RunDirectory directory_;
  std::unique_ptr<Files> files_;
};

}  // namespace monarch_flight
