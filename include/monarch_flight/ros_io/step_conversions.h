#pragma once
#include <monarch_flight/FlightState.h>
#include <monarch_flight/RoleTimes.h>
#include <monarch_flight/StepIterations.h>
#include <monarch_flight/SubIteration.h>

#include "monarch_flight/coupling/settings.h"

namespace monarch_flight {

SubIteration toMessage(const IterationRecord& record);
IterationRecord fromMessage(const SubIteration& record);
/// In the order of Role.
RoleTimes toMessage(const std::array<double, kRoles>& wall_s);

/// What a committed step says of itself.
FlightState flightState(const CommittedStep& step, const ros::Time& stamp);
StepIterations stepIterations(const CommittedStep& step, const ros::Time& stamp);

}  // namespace monarch_flight
