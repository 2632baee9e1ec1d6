#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/coupling/keeper.h"
#include "monarch_flight/run/case.h"
#include "monarch_flight/run/checkpoint_files.h"

namespace monarch_flight {

/// Where a flight was taken up again, for summary.json and for the person.
struct Resumption {
  std::uint32_t step = 0;
  std::vector<std::string> changed;  ///< keys of the case, and the version of the program
  std::vector<std::string> refused;  ///< newer checkpoints and why they could not be used
};

/// Folder of the checkpoints of a run that writes into `out`.
std::string checkpointFolder(const std::string& out);

/// The checkpoints of one run (docs/reliability.md).
class Checkpoints : public Keeper {
 public:
  /// `resume`: the run goes on from the newest checkpoint in `out` that is whole, of this case and
  /// fits the tables. `ranks`: processes of the flow; a resumed one must have as many. Throws
  /// InputError with what is wrong with each checkpoint when none can be used.
  Checkpoints(const Case& c, const std::string& out, bool resume, int ranks = 1);

  std::optional<std::uint32_t> resumed() const override;
  void load(const ShowState& coordinator) override;
  bool due(std::uint32_t step, bool last) const override;
  bool settled(std::uint32_t step) const override;
  void reset() override;
  void open(std::uint32_t step) override;
  void close(std::uint32_t step, const ShowState& coordinator) override;

  /// Step of the newest checkpoint, if there is one.
  const std::optional<std::uint32_t>& kept() const { return kept_; }
  /// The command that goes on from it: MONARCH_GO_ON of the environment, where monarch fly tells it
  /// with all keys that are needed.
  std::string command() const;
  /// Set by a resumed run only.
  const std::optional<Resumption>& resumption() const { return resumption_; }
  /// What the outputs have shown at the checkpoint; nullptr: a new run. Throws CheckpointError.
  StateVisitor* outputs() { return reader_ ? &*reader_ : nullptr; }

 private:
  void choose(const Case& c, const std::string& out);
  std::string problemOf(std::uint32_t step, const Case& c, const std::string& out,
                        Resumption& resumption);

  CheckpointFiles files_;
  CheckpointFacts facts_;
  bool led_by_node_;  // whose program must be named again
  std::string out_;
  std::string case_yaml_;
  std::uint32_t every_;
  std::vector<std::string> parts_;     // of a whole checkpoint
  std::optional<std::uint32_t> kept_;  // the newest checkpoint
  std::optional<Resumption> resumption_;
  std::vector<std::uint32_t> refused_;
  StateRecord coordinator_;            // of the checkpoint that is taken up
  std::optional<StateReader> reader_;  // of coordinator_
};

}  // namespace monarch_flight
