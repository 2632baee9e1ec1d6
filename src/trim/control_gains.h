#pragma once
#include <vector>

#include "monarch_flight/trim/control_design.h"
#include "trim/control_space.h"

namespace monarch_flight {

/// The maps between samples about an orbit, by central differences of whole flights: states of the
/// space, filters (value, rate, acceleration of each input), integrals over flaps of the means; the
/// inputs are the commands.
std::vector<LinearStage> linearise(const PhaseMap& map, const ControlSpace& space,
                                   const std::vector<FlapState>& orbit,
                                   const WingbeatStart& wingbeat);

/// Gains by Riccati's recursion, with the multipliers of both loops. NumericalError where the
/// inputs cannot hold the states.
LinearLaw linearLaw(std::vector<LinearStage> stages, const ControlSpace& space,
                    const ControlOptions& options);

/// The heading's law about an orbit, with its turn; of wings that differ with the commands and
/// states of the trim.
void designLateral(ControlDesign& design, const PhaseMap& map, const ControlTrim& trim,
                   const std::vector<FlapState>& orbit, const WingbeatStart& wingbeat);

}  // namespace monarch_flight
