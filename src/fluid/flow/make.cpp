#include <utility>

#include "fluid/pressure/blas.h"
#include "fluid/processes/shared_flow.h"
#include "monarch_flight/fluid/navier_stokes.h"
#include "monarch_flight/fluid/processes.h"

namespace monarch_flight {

std::unique_ptr<FluidModel> makeNavierStokes(const Planform& planform, const Air& air,
                                             const GridSettings& settings, double watchdog_s,
                                             int flows) {
  const int threads = flowThreads(flowProcessesHere(), flows);
  fluid::pressure::takeBlasBuffers(threads);  // before the grid is there
  Grid grid = makeGrid(planform, settings);
  const double chord = planform.meanChord();
  if (flowProcesses() > 1) {
    return std::make_unique<fluid::processes::SharedFlow>(grid, air, chord, settings.courant_limit,
                                                          MPI_COMM_WORLD, watchdog_s, threads);
  }
  return std::make_unique<fluid::NavierStokes>(std::move(grid), air, chord, settings.courant_limit,
                                               MPI_COMM_NULL, threads);
}

}  // namespace monarch_flight
