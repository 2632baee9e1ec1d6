#pragma once
#include <string>
#include <vector>

#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// What people should know of a run of the first `steps` steps of a case, beside its figures, a
/// sentence each: that nothing is ever free, though it might be; that a remainder of the length
/// asked for is not flown; that the time step is coarse for the swings of a hinge. For the screen
/// before the run, and for summary.json.
std::vector<std::string> runRemarks(const Case& c, std::uint32_t steps);

}  // namespace monarch_flight
