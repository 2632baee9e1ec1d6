// One flap of the monarch (tethered_fwuav): three grids, three time steps, three domain sizes.
#include <algorithm>
#include <numeric>

#include "verify/monarch.h"
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

/// Mean over the flap and largest magnitude after its first tenth.
struct Figures {
  double mean, peak;
};

Figures figures(const std::vector<double>& f) {
  const std::size_t begin = f.size() / 10;
  const auto [low, high] = std::minmax_element(f.begin() + begin, f.end());
  const double mean = std::accumulate(f.begin(), f.end(), 0.0) / f.size();
  return {mean, std::max(std::abs(*low), std::abs(*high))};
}

struct Quantity {
  const char* name;
  std::vector<double> FlapSeries::*series;
};
constexpr Quantity kQuantities[] = {{"lift", &FlapSeries::lift},
                                    {"thrust", &FlapSeries::thrust},
                                    {"pitch moment", &FlapSeries::M_y},
                                    {"power", &FlapSeries::power}};

/// The `standard` layout at another resolution in every direction.
GridSettings scaled(double cells_per_chord) {
  GridSettings s = GridSettings::preset("standard");
  const double finer = cells_per_chord / s.cells_per_chord;
  s.level = "custom";
  s.cells_per_chord = cells_per_chord;
  s.first_cell /= finer;
  s.growth_plane = s.growth_normal = 1 + (s.growth_plane - 1) / finer;
  return s;
}

/// Rows and curves of one study; h falls from run to run, the last is the finest.
void study(Report& report, const char* what, const double h[3], const FlapSeries* runs[3],
           const std::string& resolution, bool bounded) {
  for (const Quantity& q : kQuantities) {
    double mean[3], peak[3];
    for (int i = 0; i < 3; ++i) {
      const Figures f = figures(runs[i]->*q.series);
      mean[i] = f.mean;
      peak[i] = f.peak;
    }
    const Extrapolated m = extrapolate(h, mean), p = extrapolate(h, peak);
    const std::string name = std::string(q.name) + ", " + what;
    // Thrust and moment pass through zero: their means are measured by their peaks.
    const bool by_peak = std::abs(m.value) < 0.2 * std::abs(p.value);
    const double scale = by_peak ? p.value : m.value;
    if (bounded) {
      report.near(name + ": mean", resolution, mean[2], m.value, 0.03, scale);
      report.near(name + ": peak", resolution, peak[2], p.value, 0.05);
    } else {
      report.state(name + ": mean", resolution, mean[2], m.value);
      report.state(name + ": peak", resolution, peak[2], p.value);
    }
    report.state(name + ": order of mean, of peak", resolution, m.order, p.order);
    Curve c{std::string("monarch_flap_") + what,
            what,
            "(value - extrapolated) / peak",
            q.name,
            {},
            {},
            false};
    for (int i = 0; i < 3; ++i) {
      c.x.push_back(h[i]);
      c.y.push_back((mean[i] - m.value) / p.value);
    }
    report.curve(std::move(c));
  }
}

void gridStudy(Report& report) {
  const double cells[3] = {14, 20, 28}, h[3] = {1 / 14.0, 1 / 20.0, 1 / 28.0};
  const FlapSeries* runs[3];
  for (int i = 0; i < 3; ++i) runs[i] = &monarchSeries(scaled(cells[i]), 500, 1);
  study(report, "grid", h, runs, "14, 20, 28 cells a chord", true);
  const char* names[3] = {"14 cells a chord", "20", "28"};
  for (int i = 0; i < 3; ++i) {
    Curve c{"monarch_flap_lift", "step", "lift [N]", names[i], {}, runs[i]->lift, false};
    for (std::size_t n = 0; n < c.y.size(); ++n) c.x.push_back(n + 1.0);
    report.curve(std::move(c));
  }
}

void timeStudy(Report& report) {
  const double h[3] = {1 / 250.0, 1 / 500.0, 1 / 1000.0};
  const int steps[3] = {250, 500, 1000};
  GridSettings grid = GridSettings::preset("preview");
  grid.courant_limit = kNoCourantLimit;
  const FlapSeries* runs[3];
  for (int i = 0; i < 3; ++i) runs[i] = &monarchSeries(grid, steps[i], 1);
  study(report, "time step", h, runs, "250, 500, 1000 steps", false);
  for (const Quantity& q : kQuantities) {  // what a run of 500 steps owes to its time step
    double mean[3], peak[3];
    for (int i = 0; i < 3; ++i) {
      const Figures f = figures(runs[i]->*q.series);
      mean[i] = f.mean;
      peak[i] = f.peak;
    }
    const double best = extrapolate(h, peak).value;
    report.near(std::string(q.name) + ", 500 steps: mean", "preview", mean[1],
                extrapolate(h, mean).value, 0.03, best);
    report.near(std::string(q.name) + ", 500 steps: peak", "preview", peak[1], best, 0.05);
  }
}

void domainStudy(Report& report) {
  const double far[3] = {6, 10, 16};
  const FlapSeries* runs[3];
  for (int i = 0; i < 3; ++i) {
    GridSettings grid = GridSettings::preset("preview");
    grid.far_field = far[i];
    runs[i] = &monarchSeries(grid, 500, 1);
  }
  for (const Quantity& q : kQuantities) {
    const Figures large = figures(runs[2]->*q.series);
    for (int i = 0; i < 2; ++i) {
      const Figures f = figures(runs[i]->*q.series);
      const std::string size = text("box beyond %g, against 16", far[i]);
      report.near(std::string(q.name) + ", box: mean", size, f.mean, large.mean, 0.03, large.peak);
      report.near(std::string(q.name) + ", box: peak", size, f.peak, large.peak, 0.05);
    }
  }
}

}  // namespace

void monarchFlap(Report& report) {
  domainStudy(report);
  timeStudy(report);
  gridStudy(report);
}

}  // namespace monarch_flight::verify
