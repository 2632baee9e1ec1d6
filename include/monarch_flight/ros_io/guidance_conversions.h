#pragma once
#include <monarch_flight/GuidanceState.h>
#include <monarch_flight/WingbeatCommand.h>

#include "monarch_flight/insect/wingbeat.h"

namespace monarch_flight {

/// `at_once` of the message is left as it is by default.
WingbeatCommand toMessage(const WingbeatChange& change);
GuidanceState toMessage(const GuidanceReport& report);
WingbeatChange fromMessage(const WingbeatCommand& command);

}  // namespace monarch_flight
