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

/// Measured by a few steps on a coarse grid around this wing, a fraction of a second: at 9 cells to
/// a chord or at as many more as resolve it, at most those of `settings`, the grid of the run.
FlowCost measureFlowCost(const Planform& planform, const GridSettings& settings, int threads = 1);

/// Bytes that the flow solver holds for a grid in `here` of its `processes`, those of one machine.
double flowMemory(const Grid& grid, int processes, int here);
/// Bytes more that process 0 holds while it makes a checkpoint.
double checkpointMemory(const Grid& grid);

/// Unknowns of the wing's capacitance system: its faces and those beside its rim.
long capacitanceUnknowns(const Grid& grid);
/// Wall time of that system [s]: made once, and for one evaluation.
double capacitanceSetup(long unknowns);
double capacitanceEvaluation(long unknowns);

/// Time of a step on `processes` over that on one: the chains along z are not shared beyond two
/// (docs/scaling.md).
double parallelShare(int processes);

}  // namespace monarch_flight
