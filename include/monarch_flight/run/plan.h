#pragma once
#include <string>

#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// What a Navier-Stokes run of a case means, known before it starts. SI.
struct RunPlan {
  int cells_x = 0, cells_y = 0, cells_z = 0;
  long cells = 0, wing_faces = 0;
  double chord = 0.0, span = 0.0;                      ///< mean chord; span [m]
  double cells_per_chord = 0.0, cells_per_span = 0.0;  ///< over the wing
  double in_plane = 0.0, first_height = 0.0;           ///< smallest spacings [m]
  double stokes_layer = 0.0;    ///< sqrt(2 nu / omega) of the flapping; 0 without a period [m]
  double cells_in_layer = 0.0;  ///< that it holds, counted from the wing
  double reynolds = 0.0;        ///< of the wing's fastest point and the mean chord
  double courant_tip = 0.0,
         courant_body = 0.0;  ///< peak speeds of outline and root x dt / in_plane
  double courant_flow = 0.0;  ///< expected of the flow round the wing: what the solver watches
  double courant_limit = 0.0;
  std::string shorter_steps;  ///< that keep the limit, in words; empty: those of the case do
  double captured = 0.0;      ///< area of the wing's staircase over that of its outline
  double memory = 0.0, memory_left = 0.0;  ///< needed; available on this machine [bytes]
  int ranks = 1;                           ///< processes of the flow
  int ranks_here = 1;                      ///< of them on this machine
  int threads = 1;                         ///< of each of them
  long steps = 0;
  double evaluations = 0.0;            ///< of the air in a step, expected
  double setup_s = 0.0, step_s = 0.0;  ///< expected wall time [s]
  double exchange_s = 0.0;             ///< the longest answer to a node that waits, START apart [s]
  double run_s() const { return setup_s + steps * step_s; }
  /// Least watchdog_s with which nodes and processes wait long enough for these times [s].
  double watchdogNeeded() const;
};

/// Plans a case on `ranks` processes, `here` of them on this machine (0: all); calibrates the time
/// by a few coarse steps (a fraction of a second). Precondition: c.fluid is Navier-Stokes.
RunPlan planRun(const Case& c, int ranks, int here = 0);

/// Throws InputError when the machine cannot hold the run, or the grid misses the wing
/// (docs/case_files.md, grid).
void requirePossible(const RunPlan& plan);
/// Throws InputError when nodes, or processes of the flow, that wait so long [s] would give up.
void requireInTime(const RunPlan& plan, double watchdog_s);

/// Some lines for people.
std::string describe(const RunPlan& plan);

}  // namespace monarch_flight
