#include "monarch_flight/run/plan.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "monarch_flight/fluid/flow_cost.h"
#include "monarch_flight/fluid/grid.h"
#include "monarch_flight/fluid/processes.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/wing_speeds.h"
#include "run/case/parts.h"

namespace monarch_flight {
namespace {

// The air flows faster round the wing's edges than the tip moves: largest Courant number of a
// flight over that of the tip's speed, measured (docs/performance.md).
constexpr double kFlowByTip = 1.65;
constexpr double kMostMissed = 0.1;        // of the wing's area, by its staircase
constexpr double kStartByExchange = 10.0;  // waits of the nodes for START over those for an answer
// Evaluations of the air in a step with free coordinates (docs/coupling.md, `added_mass`).
constexpr double kEvaluationsFree = 2.1;

/// The number behind a key in a file of lines "key number ..."; 0 where there is none.
double valueOf(const char* path, const std::string& wanted) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    double value = 0.0;
    if (words >> key >> value && key == wanted) return value;
  }
  return 0.0;
}

/// Memory that this machine, or the group that the process is in, can still give [bytes].
double availableMemory() {
  double left = 1024.0 * valueOf("/proc/meminfo", "MemAvailable:");
  double limit = 0.0, used = 0.0;
  std::ifstream group("/sys/fs/cgroup/memory.max"), now("/sys/fs/cgroup/memory.current");
  if (group >> limit && now >> used) {
    const double reclaimable = valueOf("/sys/fs/cgroup/memory.stat", "inactive_file");
    left = std::min(left, std::max(0.0, limit - (used - reclaimable)));
  }
  return left;
}

/// Cells above the wing's plane within `height`, the last one in part.
double cellsWithin(const Grid& grid, double height) {
  double cells = 0.0;
  for (int k = grid.k_wing; k < grid.z.n() && grid.z.face[k] < height; ++k) {
    cells += std::min(1.0, (height - grid.z.face[k]) / grid.z.width[k]);
  }
  return cells;
}

void planGrid(const Case& c, const Grid& grid, RunPlan& plan) {
  const Planform& wing = c.insect.wings.right.planform;
  plan.cells_x = grid.x.n();
  plan.cells_y = grid.y.n();
  plan.cells_z = grid.z.n();
  plan.cells = grid.cells();
  plan.wing_faces = std::count(grid.wing.begin(), grid.wing.end(), 1);
  plan.chord = wing.meanChord();
  plan.span = wing.span();
  const double dx = *std::min_element(grid.x.width.begin(), grid.x.width.end());
  const double dy = *std::min_element(grid.y.width.begin(), grid.y.width.end());
  plan.cells_per_chord = plan.chord / dx;
  plan.cells_per_span = plan.span / dy;
  plan.in_plane = std::min(dx, dy);
  plan.first_height = grid.z.width[grid.k_wing];
  for (int j = 0; j < grid.y.n(); ++j) {
    for (int i = 0; i < grid.x.n(); ++i) {
      if (grid.isWing(i, j)) plan.captured += grid.x.width[i] * grid.y.width[j] / wing.area();
    }
  }
  if (c.time.period > 0.0) {
    plan.stokes_layer = std::sqrt(c.air.mu / c.air.rho * c.time.period / M_PI);
    plan.cells_in_layer = cellsWithin(grid, plan.stokes_layer);
  }
}

void planSpeeds(const Case& c, RunPlan& plan) {
  const WingSpeeds peak = peakWingSpeeds(c);
  const double per_speed = c.time.dt / plan.in_plane;
  plan.reynolds = c.air.rho * peak.outline * plan.chord / c.air.mu;
  plan.courant_tip = peak.outline * per_speed;
  plan.courant_body = peak.root * per_speed;
  plan.courant_flow = kFlowByTip * plan.courant_tip;
  plan.courant_limit = c.grid.courant_limit;
  if (plan.courant_flow > plan.courant_limit)
    plan.shorter_steps =
        case_file::shorterSteps(c, c.time.dt * plan.courant_limit / plan.courant_flow);
}

void planTime(const Case& c, long unknowns, RunPlan& plan) {
  const FlowCost cost = measureFlowCost(c.insect.wings.right.planform, c.grid, plan.threads);
  const bool prescribed = c.free.count() == 0;
  plan.steps = c.time.steps;
  plan.evaluations = prescribed ? 1.0 : kEvaluationsFree;
  const double cells = static_cast<double>(plan.cells);
  plan.setup_s = capacitanceSetup(unknowns);
  const double share = parallelShare(plan.ranks) * cells;
  plan.step_s = share * (cost.first + (plan.evaluations - 1) * cost.repeated) +
                plan.evaluations * capacitanceEvaluation(unknowns);
  // An answer with the load operator takes as many evaluations more as it has columns.
  const bool linearised = !prescribed && c.coupling.relaxation == Relaxation::kAddedMass;
  const int evaluations = linearised ? 7 : 1;
  plan.exchange_s = share * (cost.first + (evaluations - 1) * cost.repeated) +
                    evaluations * capacitanceEvaluation(unknowns);
}

std::string bytesText(double bytes) {
  std::ostringstream text;
  text << std::setprecision(3);
  bytes < 1e9 ? text << bytes / 1e6 << " MB" : text << bytes / 1e9 << " GB";
  return text.str();
}

std::string timeText(double seconds) {
  std::ostringstream text;
  text << std::setprecision(2);
  if (seconds < 60) {
    text << seconds << " s";
  } else if (seconds < 5400) {
    text << std::round(seconds / 6) / 10 << " min";
  } else {
    text << std::setprecision(3) << seconds / 3600 << " h";
  }
  return text.str();
}

}  // namespace

double RunPlan::watchdogNeeded() const { return std::max(setup_s / kStartByExchange, exchange_s); }

RunPlan planRun(const Case& c, int ranks, int here) {
  const Grid grid = makeGrid(c.insect.wings.right.planform, c.grid);
  RunPlan plan;
  plan.ranks = ranks;
  plan.ranks_here = here > 0 ? here : ranks;
  plan.threads = flowThreads(plan.ranks_here, c.mirrored ? 1 : 2);
  planGrid(c, grid, plan);
  planSpeeds(c, plan);
  for (Side side : c.sides()) {
    const Grid own = makeGrid(c.insect.wings[side].planform, c.grid);
    plan.memory += flowMemory(own, ranks, plan.ranks_here);
    if (c.output.checkpoint_every > 0) plan.memory += checkpointMemory(own);
  }
  plan.memory_left = availableMemory();
  planTime(c, capacitanceUnknowns(grid), plan);
  return plan;
}

void requirePossible(const RunPlan& plan) {
  std::vector<std::string> faults;
  if (plan.memory > plan.memory_left) {
    faults.push_back("grid: " + std::to_string(plan.cells) + " cells and " +
                     std::to_string(plan.wing_faces) + " faces of the wing need " +
                     bytesText(plan.memory) +
                     " of memory, must be <= " + bytesText(plan.memory_left) +
                     ", what this machine has left; lower grid/cells_per_chord or "
                     "grid/far_field, or use a larger machine");
  }
  if (std::abs(plan.captured - 1.0) > kMostMissed) {
    std::ostringstream text;
    text << "grid/cells_per_chord: " << plan.wing_faces << " faces of the wing cover "
         << plan.captured << " of its area: must be within " << kMostMissed
         << " of 1; raise cells_per_chord";
    faults.push_back(text.str());
  }
  if (plan.cells_z < 2 * plan.ranks) {
    faults.push_back("ranks = " + std::to_string(plan.ranks) + ": must be at most " +
                     std::to_string(plan.cells_z / 2) +
                     ", half the planes of the grid normal to the wing; use fewer processes or a "
                     "finer grid");
  }
  if (!faults.empty()) throw InputError(faults);
}

void requireInTime(const RunPlan& plan, double watchdog_s) {
  if (plan.watchdogNeeded() <= watchdog_s) return;
  std::ostringstream text;
  text << std::setprecision(3) << "watchdog_s = " << watchdog_s << " s: the set-up takes about "
       << timeText(plan.setup_s) << " (START is waited for " << kStartByExchange
       << " times as long as an answer) and the longest answer " << timeText(plan.exchange_s)
       << ": must be >= " << std::ceil(plan.watchdogNeeded()) << "; raise it well above that"
       << (plan.ranks > 1 ? "" : ", or fly with in_process:=true");
  throw InputError(text.str());
}

std::string describe(const RunPlan& p) {
  std::ostringstream text;
  text << std::setprecision(3);
  text << "grid: " << p.cells_x << " x " << p.cells_y << " x " << p.cells_z << " = "
       << p.cells / 1e6 << " million cells, " << p.wing_faces << " faces of the wing, "
       << p.captured << " of its area\n"
       << "resolution: " << p.cells_per_chord << " cells a mean chord of " << p.chord << " m, "
       << p.cells_per_span << " along the span; smallest spacing " << p.in_plane
       << " m in the wing's plane, " << p.first_height << " m above it\n";
  text << "Reynolds number " << p.reynolds << " (fastest point of the wing, mean chord)";
  if (p.stokes_layer > 0.0) {
    text << "; Stokes layer sqrt(2 nu / omega) " << p.stokes_layer << " m, " << p.cells_in_layer
         << " cells";
  }
  text << "\nCourant number: wing " << p.courant_tip << ", wing root " << p.courant_body
       << "; expected in the flow " << p.courant_flow << ", limit " << p.courant_limit;
  if (p.courant_flow > p.courant_limit)
    text << " - this run may end on it; take " << p.shorter_steps;
  text << "\nmemory: " << bytesText(p.memory) << " of " << bytesText(p.memory_left) << " left";
  if (p.ranks_here < p.ranks) text << " here, where " << p.ranks_here << " of the processes are";
  text << '\n'
       << "time: set-up " << timeText(p.setup_s) << ", " << p.steps << " steps of "
       << timeText(p.step_s) << " as measured just now (" << p.evaluations
       << (p.evaluations == 1 ? " evaluation of the air, " : " evaluations of the air, ") << p.ranks
       << (p.ranks == 1 ? " process, " : " processes, ") << p.threads
       << (p.threads == 1 ? " thread): " : " threads each): ") << timeText(p.run_s())
       << "; nodes and several processes need watchdog_s >= " << p.watchdogNeeded() << "\n";
  return text.str();
}

}  // namespace monarch_flight
