// Drag of a disc that moves along its axis, against an experiment and a published fit. Bounds:
// docs/verification.md, "References from outside".
#include "verify/setup.h"
#include "verify/subjects.h"
#include "verify/table.h"

namespace monarch_flight::verify {
namespace {

constexpr double kCells[3] = {10, 14, 20};  // a mean chord: pi / 4 of the diameter
constexpr double kSpacing[3] = {1 / 10.0, 1 / 14.0, 1 / 20.0};
constexpr double kFarField = 20, kTravel = 16;  // mean chords; diameters

/// Roos and Willmarth (1971): straight line through the logarithms of what they measured within a
/// factor of 1.5 of this Reynolds number.
double experiment(double reynolds) {
  const Table t = readTable("disc_drag_roos_willmarth_1971.dat");
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < t.x.size(); ++i) {
    const double a = std::log(t.x[i] / reynolds), b = std::log(t.y[i]);
    if (std::abs(a) > std::log(1.5)) continue;
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return std::exp((y * xx - x * xy) / (n * xx - x * x));
}

/// Clift, Grace and Weber (1978), 1.5 < Re <= 133.
double fit(double reynolds) {
  return 64 / (M_PI * reynolds) * (1 + 0.138 * std::pow(reynolds, 0.792));
}

struct Drag {
  double coefficient, drift;  ///< mean over the last diameter; change to the one before
};

Drag fly(double reynolds, double cells_per_chord, double far_field) {
  const auto flow = makeNavierStokes(Planform::ellipse(1, 1, 0.5, -0.5), airOf(1, 1 / reynolds),
                                     scaled("preview", cells_per_chord, far_field));
  auto motion = [](double t) {
    WingMotion m;
    m.r_I = Vector3d(0, 0, t);
    m.v_W = Vector3d(0, 0, 1);
    return m;
  };
  const int per_diameter = static_cast<int>(std::lround(3 * cells_per_chord));
  const int steps = static_cast<int>(kTravel) * per_diameter;
  const auto loads = verify::fly(*flow, motion, 1.0 / per_diameter, steps);
  auto mean = [&](int end) {
    double sum = 0;
    for (int n = end - per_diameter; n < end; ++n) sum -= loads[n].force().z();
    return sum / per_diameter / (0.5 * M_PI / 4);
  };
  const double last = mean(steps);
  return {last, std::abs(last / mean(steps - per_diameter) - 1)};
}

}  // namespace

void discDrag(Report& report) {
  for (double reynolds : {100.0, 30.0, 10.0}) {
    const std::string at = text("Re %g: ", reynolds);
    double drag[3];
    for (int i = 0; i < 3; ++i) {
      const std::string resolution = text("%g cells a chord, box 20", kCells[i]);
      const Drag d = fly(reynolds, kCells[i], kFarField);
      drag[i] = d.coefficient;
      report.state(at + "drift over a diameter", resolution, d.drift, 0);
      if (i < 2) report.state(at + "CD, experiment", resolution, drag[i], experiment(reynolds));
    }
    report.near(at + "CD, experiment", "20 cells a chord, box 20", drag[2], experiment(reynolds),
                0.08);
    report.near(at + "CD, fit", "20 cells a chord, box 20", drag[2], fit(reynolds), 0.12);
    const Extrapolated e = extrapolate(kSpacing, drag);
    report.state(at + "CD against extrapolated", "20 cells a chord", drag[2], e.value);
    report.state(at + "order of CD", "10, 14, 20 cells", e.order, 0);
    for (double far : {10.0, 40.0})
      report.state(at + "CD against box 20", text("10 cells a chord, box %g", far),
                   fly(reynolds, kCells[0], far).coefficient, drag[0]);
    report.curve({"disc_drag",
                  "spacing [chords]",
                  "CD / experiment",
                  text("Re %g", reynolds),
                  std::vector<double>(kSpacing, kSpacing + 3),
                  {drag[0] / experiment(reynolds), drag[1] / experiment(reynolds),
                   drag[2] / experiment(reynolds)},
                  false});
  }
}

}  // namespace monarch_flight::verify
