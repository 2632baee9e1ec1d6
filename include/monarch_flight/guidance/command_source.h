#pragma once
#include <array>
#include <optional>

#include "monarch_flight/coupling/guidance.h"

namespace monarch_flight {

/// All of the committed level that a leader of the wingbeat may know.
struct WingbeatLevel {
  const GuidanceInput& level;     ///< n, and the number and time of level n+1
  double phase = 0.0;             ///< at level n, flaps since t = 0: flap = floor(phase)
  double frequency = 0.0;         ///< of the case's motion [Hz]
  double dt = 0.0;                ///< [s]
  const WingbeatChange& command;  ///< taken so far
  const std::array<Coordinate, kCommands>& applied;  ///< the filters at level n
};

/// Leads the wingbeat: a person by a topic, a controller, a node.
class CommandSource {
 public:
  virtual ~CommandSource() = default;
  /// A new run, or the same one set back: forgets everything.
  virtual void start() = 0;
  /// Asked once a step, at the committed level n: the command from there on; nothing: as before.
  virtual std::optional<WingbeatChange> next(const WingbeatLevel& level) = 0;
  /// It has given up, and the last command stays.
  virtual bool lost() const { return false; }
  /// What one step leaves to the next; numbers only.
  virtual void memory(StateVisitor&) {}
};

}  // namespace monarch_flight
