#pragma once
#include <cstdint>
#include <functional>
#include <optional>

#include "monarch_flight/coupling/state_visitor.h"

namespace monarch_flight {

/// Shows a state to a visitor.
using ShowState = std::function<void(StateVisitor&)>;

/// Keeps the checkpoints of a run (run/checkpoints.h). A checkpoint is opened, every participant
/// writes its own part (CHECKPOINT), and the coordinator's part closes it: only then does it count.
class Keeper {
 public:
  virtual ~Keeper() = default;
  /// The step that the run goes on from; nothing: it begins at level 0.
  virtual std::optional<std::uint32_t> resumed() const = 0;
  /// Loads what `close` was shown at that step.
  virtual void load(const ShowState& coordinator) = 0;
  /// Whether a checkpoint is due after this committed step. `last`: of the run.
  virtual bool due(std::uint32_t step, bool last) const = 0;
  /// Whether the state of this step is kept already, or none ever is.
  virtual bool settled(std::uint32_t step) const = 0;
  /// The run goes back to level 0: what has been kept is void.
  virtual void reset() = 0;
  /// Both throw OutputError when the disk refuses.
  virtual void open(std::uint32_t step) = 0;
  virtual void close(std::uint32_t step, const ShowState& coordinator) = 0;
};

}  // namespace monarch_flight
