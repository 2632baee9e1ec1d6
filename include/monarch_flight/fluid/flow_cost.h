#pragma once
#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/fluid/grid.h"

namespace monarch_flight {

/// Wall time of the flow solver per cell on one process of this machine, without what grows with
/// the wing's faces [s].
struct FlowCost {
  double first = 0.0;     ///< first evaluation of a step, and its commit
  double repeated = 0.0;  ///< another evaluation of the same step
};

/// Measured by a few steps on a coarse grid around this wing: a fraction of a second.
FlowCost measureFlowCost(const Planform& planform, const Air& air);

/// Bytes that the flow solver holds for a grid, on all processes together.
double flowMemory(const Grid& grid, int processes);

/// Wall time of the wing's capacitance system [s]: made once, and for one evaluation.
double capacitanceSetup(long wing_faces);
double capacitanceEvaluation(long wing_faces);

/// Time of a step on `processes` over that on one: the chains along z are not shared beyond two
/// (docs/scaling.md).
double parallelShare(int processes);

}  // namespace monarch_flight
