#pragma once
#include <memory>

#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/fluid/grid.h"

namespace monarch_flight {

/// Three-dimensional incompressible Navier-Stokes around one zero-thickness wing (docs/fluid.md),
/// on all processes that mpirun started (processes.h). Throws InputError for a grid that does not
/// fit. On several processes `watchdog_s` limits the waits of one for another (shared_flow.h) [s];
/// 0: no limit.
std::unique_ptr<FluidModel> makeNavierStokes(const Planform& planform, const Air& air,
                                             const GridSettings& settings, double watchdog_s = 0.0,
                                             int flows = 1);

}  // namespace monarch_flight
