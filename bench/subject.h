#pragma once
#include <time.h>

#include <algorithm>
#include <string>
#include <vector>

#include "monarch_flight/fluid/grid.h"
#include "monarch_flight/insect/insect.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// What all benchmarks compute: the wing and the motion of case tethered_fwuav, on a grid of about
/// a given number of cells.
class Subject {
 public:
  Subject() : case_(loadCase("tethered_fwuav", {}, CONFIG_DIR)) {}

  /// A grid between the levels (and beyond them) of about `cells`.
  Grid grid(double cells) const {
    double low = 6, high = 120;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (gridAt(middle).cells() > cells ? high : low) = middle;
    }
    return gridAt(0.5 * (low + high));
  }
  WingMotion motion(double t) const {
    const PrescribedState s = case_.motion->at(t);
    return wingMotion(Side::kRight, case_.insect, s.body, s.angles);
  }
  const Air& air() const { return case_.air; }
  double chord() const { return case_.insect.wings.right.planform.meanChord(); }
  /// The case's time step up to the standard grid's resolution, beyond it smaller: the
  /// motion begins at once, and the finer the grid, the faster the flow round the edges then.
  double dt(const Grid& grid) const {
    const double finest = *std::min_element(grid.x.width.begin(), grid.x.width.end());
    const double refined = std::min(1.0, 28 * finest / chord());
    return case_.time.dt * refined * refined;
  }

 private:
  Grid gridAt(double cells_per_chord) const {
    GridSettings s = GridSettings::preset("standard");
    s.level = "custom";
    s.first_cell *= s.cells_per_chord / cells_per_chord;
    s.cells_per_chord = cells_per_chord;
    s.growth_plane = s.growth_normal =  // as from level to level
        std::clamp(1.25 - 0.0025 * (cells_per_chord - 28), 1.12, 1.3);
    return makeGrid(case_.insect.wings.right.planform, s);
  }
  Case case_;
};

/// Of the benchmarks: the first steps after the start at once may exceed that of a run.
constexpr double kCourantLimit = 100.0;

/// Computing time of this process [s]; other processes on the machine do not count.
inline double cpuSeconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}
inline double wallSeconds() {
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

inline double best(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }
inline double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
  return v[v.size() / 2];
}

}  // namespace monarch_flight
