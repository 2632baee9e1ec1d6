#include "monarch_flight/fluid/flow_cost.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "fluid/flow.h"

namespace monarch_flight {
namespace {

constexpr double kCellsPerChord = 9;  // of the coarse grid: some ten thousand cells
constexpr int kSteps = 5;             // that are timed, the best of them counts

// Measured, docs/performance.md ("Cost model").
constexpr double kBytesPerCell = 205;       // 19 fields, ghosts and padding
constexpr double kBytesBeside = 60e6;       // program and libraries
constexpr double kSetupRate = 3.0e10;       // n_w^3 a second: assembly and inverse
constexpr double kCapacitanceRate = 1.0e10; // bytes a second of the inverse, half of it read
constexpr double kChainShare = 0.20;        // of a step's time in chains along z

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

FlowCost measureFlowCost(const Planform& planform, const Air& air) {
  GridSettings coarse = GridSettings::preset("preview");
  coarse.cells_per_chord = kCellsPerChord;
  NavierStokes flow(makeGrid(planform, coarse), air, planform.meanChord(), 1e9);
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

double flowMemory(const Grid& grid, int processes) {
  const double faces = static_cast<double>(std::count(grid.wing.begin(), grid.wing.end(), 1));
  const double plane = double(grid.x.n()) * grid.y.n();
  // Processes that touch the wing's plane hold its inverse; each stores two planes of neighbours.
  const double holders = std::min(processes, 2);
  return kBytesPerCell * (static_cast<double>(grid.cells()) + 3 * plane * processes) +
         8 * faces * faces * holders + kBytesBeside * processes;
}

double capacitanceSetup(long wing_faces) { return std::pow(double(wing_faces), 3) / kSetupRate; }

double capacitanceEvaluation(long wing_faces) {
  return 4 * std::pow(double(wing_faces), 2) / kCapacitanceRate;
}

double parallelShare(int processes) {
  if (processes <= 2) return 1.0 / processes;
  return (1 - kChainShare) / processes + 0.5 * kChainShare;
}

}  // namespace monarch_flight
