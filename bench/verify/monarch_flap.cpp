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

/// Rows and curves of one study; h falls from run to run. What the middle run, the one in use, owes
/// to h is bounded.
void study(Report& report, const char* what, const double h[3], const FlapSeries* runs[3],
           const std::string& resolution, const std::string& in_use) {
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
    report.near(name + ": mean", in_use, mean[1], m.value, 0.03, by_peak ? p.value : m.value);
    report.near(name + ": peak", in_use, peak[1], p.value, 0.05);
    report.state(name + ": finest mean", resolution, mean[2], m.value);
    report.state(name + ": finest peak", resolution, peak[2], p.value);
    report.state(name + ": order of mean, of peak", resolution, m.order, p.order);
    Curve c{std::string("monarch_flap_") + what,
            std::string(what) == "grid" ? "spacing [chords]" : "time step [periods]",
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

/// The standard grid between a coarser and a finer one, in time steps that the finest can take.
void gridStudy(Report& report) {
  const double cells[3] = {20, 28, 40}, h[3] = {1 / 20.0, 1 / 28.0, 1 / 40.0};
  const FlapSeries* runs[3];
  for (int i = 0; i < 3; ++i) runs[i] = &monarchSeries(scaled("standard", cells[i]), 1000, 1);
  study(report, "grid", h, runs, "20, 28, 40 cells a chord", "standard, 28 cells");
  const char* names[3] = {"20 cells a chord", "28", "40"};
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
  study(report, "time step", h, runs, "250, 500, 1000 steps", "preview, 500 steps");
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
