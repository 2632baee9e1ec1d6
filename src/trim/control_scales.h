#pragma once
#include <Eigen/Dense>
#include <cstddef>

#include "monarch_flight/trim/flap_map.h"

namespace monarch_flight {

/// A change of a command that matters, in its unit: makes it dimensionless.
double commandScale(std::size_t command);
/// How many of a FlapState's components, from the first one, move freely.
int controlStates(const Case& c);
/// The state with its first components from these, in their own units, and both wings alike.
FlapState with(FlapState state, const Eigen::VectorXd& components);

}  // namespace monarch_flight
