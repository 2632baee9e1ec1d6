#pragma once
#include <cstddef>

#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// A change of a command that matters, in its unit: makes it dimensionless.
double commandScale(std::size_t command);
/// How many of a FlapState's components, from the first one, move freely.
int controlStates(const Case& c);

}  // namespace monarch_flight
