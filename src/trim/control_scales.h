#pragma once
#include <Eigen/Dense>
#include <cstddef>

#include "monarch_flight/trim/flap_map.h"

namespace monarch_flight {

/// A change of a command that matters, in its unit: makes it dimensionless.
double commandScale(std::size_t command);
/// How many of a FlapState's components, from the first one, move freely.
int controlStates(const Case& c);
/// Those components, in units of trimScales().
Eigen::VectorXd scaled(const FlapState& state, Eigen::Index n);
/// The state with its first components from these, in their own units.
FlapState with(FlapState state, const Eigen::VectorXd& components);

}  // namespace monarch_flight
