#include "monarch_flight/guidance/command_remarks.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace monarch_flight {
namespace {

std::string refusal(const CommandInfo& info, double value) {
  std::ostringstream text;
  text << "command " << info.name << " = " << value
       << ": must be a finite number; the message is refused and the last command stays, send "
          "another";
  return text.str();
}

std::string cut(const CommandInfo& info, double value, const CommandLimits& limits) {
  std::ostringstream text;
  text << "command " << info.name << " = " << value << (*info.unit ? " " : "") << info.unit;
  if (limits.low == 0.0 && limits.high == 0.0) {
    text << ": is not taken, this flight has no such command; leave it 0 (guidance/limits/"
         << info.name << " of the case, and wings independent for a difference)";
    return text.str();
  }
  text << ": is cut to " << std::clamp(value, limits.low, limits.high) << "; must be within ["
       << limits.low << ", " << limits.high << "] (guidance/limits/" << info.name
       << " of the case); send less, or widen the limits";
  return text.str();
}

}  // namespace

std::vector<std::string> CommandRemarks::on(const WingbeatChange& wanted) {
  std::vector<std::string> refusals, cuts;
  bool finite = true;
  for (std::size_t i = 0; i < kCommands; ++i) {
    const CommandInfo& info = kCommandTable[i];
    const double value = wanted.*info.value;
    if (!std::isfinite(value)) {
      finite = false;
      if (refused_.insert(i).second) refusals.push_back(refusal(info, value));
    }
  }
  if (!finite) return refusals;
  for (std::size_t i = 0; i < kCommands; ++i) {
    const CommandInfo& info = kCommandTable[i];
    const double value = wanted.*info.value;
    if (value >= limits_[i].low && value <= limits_[i].high) continue;
    if (cut_.insert(i).second) cuts.push_back(cut(info, value, limits_[i]));
  }
  return cuts;
}

}  // namespace monarch_flight
