// The edge of the wing: loads of a flapping, a heaving and a pitching plate on three grids, and
// with square cells beside the wing.
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

constexpr double kOmega = 2 * M_PI, kStandard = 28, kSquare = 1.0;
constexpr double kCells[3] = {14, 20, kStandard};

struct Case {
  const char* name;
  Planform planform;
  Motion motion;
};

struct Sizes {
  double force, moment, mean;  ///< rms of F_z and M_y, mean F_z, over half a period from a tenth on
};

/// `standard` with everything scaled to another resolution; the time step, too. The cells beside
/// the wing are `height` times as high as wide.
Sizes measure(const Case& c, double cells, double height) {
  GridSettings s = scaled("standard", cells, 6);
  s.first_cell = height / cells;
  const auto flow = makeNavierStokes(c.planform, airOf(1, 0.02), s);
  const int steps = static_cast<int>(std::lround(0.6 * 10 * cells));
  const auto loads = fly(*flow, c.motion, 0.6 / steps, steps);
  Sizes size{0, 0, 0};
  const int begin = steps / 6, count = steps - begin;
  for (int n = begin; n < steps; ++n) {
    size.force += std::pow(loads[n].force().z(), 2) / count;
    size.moment += std::pow(loads[n].moment().y(), 2) / count;
    size.mean += loads[n].force().z() / count;
  }
  return {std::sqrt(size.force), std::sqrt(size.moment), size.mean};
}

Extrapolated extrapolated(const std::vector<double>& values) {
  const double h[3] = {1 / kCells[0], 1 / kCells[1], 1 / kCells[2]};
  return extrapolate(h, values.data());
}

void draw(Report& report, const Case& c, const char* figure, const char* axis,
          const std::vector<double>& values) {
  const double limit = extrapolated(values).value;
  Curve curve{figure, "spacing [chords]", axis, c.name, {}, {}, false};
  for (int i = 0; i < 3; ++i)
    curve.x.push_back(1 / kCells[i]), curve.y.push_back(values[i] / limit);
  report.curve(std::move(curve));
}

/// The cells of `standard`.
void asStandard(Report& report, const Case& c) {
  const GridSettings s = GridSettings::preset("standard");
  std::vector<double> force, moment;
  for (const double cells : kCells) {
    const Sizes size = measure(c, cells, s.first_cell * s.cells_per_chord);
    force.push_back(size.force), moment.push_back(size.moment);
    const std::string resolution = text("%g cells a chord", cells);
    report.state(std::string(c.name) + ": F_z, rms", resolution, size.force, 0);
    report.state(std::string(c.name) + ": M_y, rms", resolution, size.moment, 0);
  }
  const Extrapolated f = extrapolated(force), m = extrapolated(moment);
  const std::string grids = "14, 20, 28 cells";
  report.near(std::string(c.name) + ": F_z of standard", grids, force[2], f.value, 0.03);
  report.near(std::string(c.name) + ": M_y of standard", grids, moment[2], m.value, 0.05);
  report.state(std::string(c.name) + ": order of F_z, of M_y", grids, f.order, m.order);
  draw(report, c, "rim", "rms F_z / extrapolated", force);
  draw(report, c, "rim_moment", "rms M_y / extrapolated", moment);
}

/// Cells beside the wing that are as high as wide: the mean and the rms load on 14 cells a chord.
void asHighAsWide(Report& report, const Case& c) {
  std::vector<double> force, mean;
  for (const double cells : kCells) {
    const Sizes size = measure(c, cells, kSquare);
    force.push_back(size.force), mean.push_back(size.mean);
    report.state(std::string(c.name) + ", square: F_z, rms, mean", text("%g cells a chord", cells),
                 size.force, size.mean);
  }
  const Extrapolated f = extrapolated(force), m = extrapolated(mean);
  const std::string grids = "14, 20, 28 cells";
  report.near(std::string(c.name) + ", square: rms F_z at 14", grids, force[0], f.value, 0.03);
  report.near(std::string(c.name) + ", square: mean F_z at 14", grids, mean[0], m.value, 0.03);
  report.order(std::string(c.name) + ", square: rms F_z", grids, f.order, 1.5);
  report.order(std::string(c.name) + ", square: mean F_z", grids, m.order, 1.5);
}

}  // namespace

void rim(Report& report) {
  const Case cases[] = {
      {"flapping", Planform::rectangle(1, 2, 0.3, 0.5),
       [](double t) {
         return flapAndPitch(oscillation(0.6, kOmega, t), oscillation(0.6, kOmega, t, M_PI / 2));
       }},
      {"heaving", Planform::rectangle(1, 2, 0.3, -1),
       [](double t) {
         const Vector3d z = oscillation(0.3, kOmega, t);
         return flapAndPitch(Vector3d::Zero(), Vector3d::Zero(), Vector3d(0, 0, z[1]),
                             Vector3d(0, 0, z[2]));
       }},
      {"pitching", Planform::rectangle(1, 2, 0.3, -1),
       [](double t) { return flapAndPitch(Vector3d::Zero(), oscillation(0.7, kOmega, t)); }}};
  for (const Case& c : cases) asStandard(report, c);
  for (const Case& c : {cases[0], cases[1]}) asHighAsWide(report, c);
}

}  // namespace monarch_flight::verify
