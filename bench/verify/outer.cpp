// The outer boundary: does the wake that leaves through it, or the box being too small, disturb the
// loads? Three flaps of the monarch (tethered_fwuav), third one compared; at rest against open, and
// boxes of three sizes.
#include <algorithm>
#include <cmath>

#include "verify/monarch.h"
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

constexpr int kSteps = 500, kFlaps = 3;
constexpr double kFar[] = {6, 10, 16};  // mean chords; 10 is that of every level
constexpr double kBound = 0.01;         // of the peak

const FlapSeries& flown(double far, const char* outer) {
  GridSettings grid = GridSettings::preset("preview");
  grid.far_field = far;
  grid.outer = outer;
  return monarchSeries(grid, kSteps, kFlaps);
}

/// Differences over the last flap, relative to the peak of the reference.
struct Difference {
  double largest, rms, mean;
};

Difference lastFlap(const std::vector<double>& f, const std::vector<double>& reference) {
  const std::size_t begin = f.size() - kSteps;
  double peak = 0, largest = 0, squares = 0, sum = 0;
  for (std::size_t i = begin; i < f.size(); ++i) {
    const double d = f[i] - reference[i];
    peak = std::max(peak, std::abs(reference[i]));
    largest = std::max(largest, std::abs(d));
    squares += d * d;
    sum += d;
  }
  return {largest / peak, std::sqrt(squares / kSteps) / peak, sum / kSteps / peak};
}

void curves(Report& report, double far, const char* outer, const FlapSeries& reference) {
  const FlapSeries& run = flown(far, outer);
  Curve c{"outer_lift",
          "step of the third flap",
          "lift against open, 16 chords [N]",
          text("%g chords, ", far) + outer,
          {},
          {},
          false};
  for (std::size_t i = run.lift.size() - kSteps; i < run.lift.size(); ++i) {
    c.x.push_back(static_cast<double>(c.x.size()));
    c.y.push_back(run.lift[i] - reference.lift[i]);
  }
  report.curve(std::move(c));
}

}  // namespace

void outerBoundary(Report& report) {
  const FlapSeries& reference = flown(16, "open");
  for (double far : kFar) {
    for (const char* outer : {"rest", "open"}) {
      if (far == 16 && std::string(outer) == "open") continue;
      const FlapSeries& run = flown(far, outer);
      for (const Quantity& q : kQuantities) {
        const Difference d = lastFlap(run.*q.series, reference.*q.series);
        const std::string name = std::string(q.name) + ", " + outer + " against open at 16 chords";
        const std::string box = text("box %g chords beyond", far);
        if (far == 10) {
          report.below(name + ": largest", box, d.largest, kBound);
        } else {
          report.state(name + ": largest", box, d.largest, 0);
        }
        report.state(name + ": rms, of peak", box, d.rms, 0);
        report.state(name + ": mean, of peak", box, d.mean, 0);
      }
      curves(report, far, outer, reference);
    }
  }
}

}  // namespace monarch_flight::verify
