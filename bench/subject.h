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

  /// The standard grid, refined or coarsened in all directions alike to about `cells`.
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
    return rightWingMotion(case_.insect, s.body, s.angles);
  }
  const Air& air() const { return case_.air; }
  double chord() const { return case_.insect.planform.meanChord(); }
  double dt() const { return case_.time.dt; }

 private:
  Grid gridAt(double cells_per_chord) const {
    GridSettings s = GridSettings::preset("standard");
    s.level = "custom";
    s.first_cell *= s.cells_per_chord / cells_per_chord;
    s.cells_per_chord = cells_per_chord;
    return makeGrid(case_.insect.planform, s);
  }
  Case case_;
};

/// The benchmarks' limit on the Courant number: the largest grids exceed that of a run.
constexpr double kNoCourantLimit = 1e3;

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
