#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "fluid/flow/flow.h"
#include "monarch_flight/fluid/flow_cost.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/seconds_since.h"

namespace monarch_flight {
namespace {

constexpr double kCellsPerChord = 9;  // of the coarse grid: some ten thousand cells
constexpr double kFiner = 1.25;       // where that does not resolve the wing
constexpr int kSteps = 20;            // that are timed, the best of them counts

// Measured, docs/performance.md ("Cost model").
constexpr double kBytesPerCell = 178;        // 20 fields, ghosts and padding
constexpr double kCheckpointPerCell = 241;   // seven fields with their rims, three times over
constexpr double kBytesBeside = 45e6;        // program and libraries
constexpr double kInverseShare = 0.6;        // of n^2 numbers, by tiles of the triangle
constexpr double kSetupRate = 2.5e10;        // n^3 a second: assembly and inverse
constexpr double kCapacitanceRate = 1.0e10;  // bytes a second of the inverse, half of it read
constexpr double kChainShare = 0.20;         // of a step's time in chains along z

/// As coarse as this wing lets it be, at most as fine as the case's own in the wing's plane.
Grid coarseGrid(const Planform& planform, const GridSettings& settings) {
  GridSettings coarse = GridSettings::preset("preview");
  for (double cells = kCellsPerChord;; cells *= kFiner) {
    coarse.cells_per_chord = std::min(cells, settings.cells_per_chord);
    try {
      return makeGrid(planform, coarse);
    } catch (const InputError&) {  // a short or a jagged wing needs more cells
      if (cells >= settings.cells_per_chord) throw;
    }
  }
}

}  // namespace

FlowCost measureFlowCost(const Planform& planform, const GridSettings& settings, int threads) {
  fluid::NavierStokes flow(coarseGrid(planform, settings), Air(), planform.meanChord(), 1e9,
                           MPI_COMM_NULL, threads);
  WingMotion motion;
  motion.omega_W.x() = 1.0;  // the cost does not depend on the motion
  flow.start(motion, 1e-4);
  FlowCost best{1e9, 1e9};
  for (int n = 0; n <= kSteps; ++n) {
    auto begin = std::chrono::steady_clock::now();
    flow.evaluate(motion);
    const double first = secondsSince(begin);
    begin = std::chrono::steady_clock::now();
    flow.evaluate(motion);
    const double repeated = secondsSince(begin);
    begin = std::chrono::steady_clock::now();
    flow.commit();
    if (n == 0) continue;  // warms the caches
    best.first = std::min(best.first, first + secondsSince(begin));
    best.repeated = std::min(best.repeated, repeated);
  }
  const double cells = static_cast<double>(flow.cells());
  return {best.first / cells, best.repeated / cells};
}

double flowMemory(const Grid& grid, int processes, int here) {
  const double n = static_cast<double>(capacitanceUnknowns(grid));
  const double plane = double(grid.x.n()) * grid.y.n();
  // Processes that touch the wing's plane hold its inverse; each stores two planes of neighbours.
  const double holders = std::min(here, 2);
  return kBytesPerCell * (static_cast<double>(grid.cells()) / processes + 3 * plane) * here +
         kInverseShare * 8 * n * n * holders + kBytesBeside * here;
}

double checkpointMemory(const Grid& grid) {
  return kCheckpointPerCell * static_cast<double>(grid.cells());
}

long capacitanceUnknowns(const Grid& grid) {
  long unknowns = 0;
  for (int j = 0; j < grid.y.n(); ++j) {
    for (int i = 0; i < grid.x.n(); ++i) {
      unknowns += grid.mobility.at(2, i, j, grid.k_wing) != 1;
      for (int k = grid.k_wing - 1; k <= grid.k_wing; ++k) {
        unknowns += grid.mobility.at(0, i, j, k) != 1;
        unknowns += grid.mobility.at(1, i, j, k) != 1;
      }
    }
  }
  return unknowns;
}

double capacitanceSetup(long unknowns) { return std::pow(double(unknowns), 3) / kSetupRate; }

double capacitanceEvaluation(long unknowns) {
  return 4 * std::pow(double(unknowns), 2) / kCapacitanceRate;
}

double parallelShare(int processes) {
  if (processes <= 2) return 1.0 / processes;
  return (1 - kChainShare) / processes + 0.5 * kChainShare;
}

}  // namespace monarch_flight
