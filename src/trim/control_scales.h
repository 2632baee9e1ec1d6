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

/// What the lateral law sees of a state (LateralState).
Eigen::VectorXd lateralState(const FlapState& state, double heading);
/// The state changed by a change of that; the heading is no part of it.
FlapState changedAside(FlapState state, const Eigen::VectorXd& change);

}  // namespace monarch_flight
