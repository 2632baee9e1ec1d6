#pragma once
#include <array>
#include <set>
#include <string>
#include <vector>

#include "monarch_flight/guidance/command_filter.h"
#include "monarch_flight/insect/wingbeat.h"

namespace monarch_flight {

/// What a person must hear of the commands that come: a value beyond its limits is cut, and with a
/// value that is not a finite number the whole message is refused. Of each command and kind once.
class CommandRemarks {
 public:
  explicit CommandRemarks(const std::array<CommandLimits, kCommands>& limits) : limits_(limits) {}
  /// Remarks on one message that have not been made before.
  std::vector<std::string> on(const WingbeatChange& wanted);

 private:
  std::array<CommandLimits, kCommands> limits_;
  std::set<std::size_t> cut_, refused_;  // indices in kCommandTable
};

}  // namespace monarch_flight
