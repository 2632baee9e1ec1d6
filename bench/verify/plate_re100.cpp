// Rectangle of aspect ratio 2 at Reynolds number 100 against an experiment and another code.
#include "verify/setup.h"
#include "verify/subjects.h"
#include "verify/table.h"

namespace monarch_flight::verify {
namespace {

constexpr double kCells[3] = {12, 16, 22}, kSpacing[3] = {1 / 12.0, 1 / 16.0, 1 / 22.0};

struct Coefficients {
  double lift, drag, drift;  ///< drift: change of drag over the last two chords of travel
};

Coefficients steady(double degrees, double cells_per_chord, double far_field) {
  const GridSettings s = scaled("preview", cells_per_chord, far_field);
  const auto flow = makeNavierStokes(Planform::rectangle(1, 2, 0.5, -1), airOf(1, 0.01), s);
  const double angle = degrees * M_PI / 180;
  auto motion = [&](double t) {
    WingMotion m;  // moves to the north, leading edge up
    m.R_IW = rotationY(angle);
    m.r_I = Vector3d(t, 0, 0);
    m.v_W = m.R_IW.transpose() * Vector3d(1, 0, 0);
    return m;
  };
  const double dt = 0.32 / cells_per_chord;
  const int steps = static_cast<int>(std::lround(13 / dt)), window = static_cast<int>(2 / dt);
  const auto loads = fly(*flow, motion, dt, steps);
  auto mean = [&](int end) {
    Vector3d sum = Vector3d::Zero();
    for (int n = end - window / 2; n < end; ++n) sum += rotationY(angle) * loads[n].force();
    return Vector3d(sum / (window / 2));
  };
  const Vector3d F = mean(steps), before = mean(steps - window / 2);
  return {-F.z(), -F.x(), std::abs(F.x() / before.x() - 1)};  // 1/2 rho U^2 S = 1
}

/// Against what was measured: bounded on the finest grid, stated on the others.
void compare(Report& report, double degrees, const std::string& resolution, bool finest,
             const Coefficients& c) {
  const double cl = readTable("flat_plate_ar2_re100_cl_vs_alpha.dat").at(degrees);
  const double cd = readTable("flat_plate_ar2_re100_cd_vs_alpha.dat").at(degrees);
  const std::string at = text("%g deg: ", degrees);
  auto row = [&](const char* name, double value, double reference, double scale) {
    if (finest) {
      report.near(at + name, resolution, value, reference, 0.1, scale);
    } else {
      report.state(at + name, resolution, value, reference);
    }
  };
  row("CL, experiment", c.lift, cl, degrees < 89 ? cl : cd);  // near zero at 90 deg
  row("CD, experiment", c.drag, cd, cd);
  if (degrees == 30) {
    row("CL, PetIBM", c.lift, 0.706, 0.706);
    row("CD, PetIBM", c.drag, 0.739, 0.739);
  }
}

/// Coefficients on three grids, and what is left to the extrapolated ones.
void gridStudy(Report& report, double degrees, double lift[3], double drag[3]) {
  for (int i = 0; i < 3; ++i) {
    const Coefficients c = steady(degrees, kCells[i], 10);
    const std::string resolution = text("%g cells a chord, box 10", kCells[i]);
    compare(report, degrees, resolution, i == 2, c);
    report.state(text("%g deg: drift over a chord", degrees), resolution, c.drift, 0);
    lift[i] = c.lift;
    drag[i] = c.drag;
  }
  const std::string at = text("%g deg: ", degrees);
  const Extrapolated l = extrapolate(kSpacing, lift), d = extrapolate(kSpacing, drag);
  if (degrees < 89)
    report.state(at + "CL against extrapolated", "22 cells a chord", lift[2], l.value);
  report.state(at + "CD against extrapolated", "22 cells a chord", drag[2], d.value);
  report.state(at + "order of CL, of CD", "12, 16, 22 cells", l.order, d.order);
}

}  // namespace

void plateRe100(Report& report) {
  double lift[3], drag[3];
  for (double degrees : {60.0, 90.0, 30.0}) gridStudy(report, degrees, lift, drag);
  for (double far : {6.0, 16.0}) {
    const Coefficients c = steady(30, 16, far);
    const std::string resolution = text("16 cells a chord, box %g", far);
    report.state("30 deg: CL against box 10", resolution, c.lift, lift[1]);
    report.state("30 deg: CD against box 10", resolution, c.drag, drag[1]);
  }
  const std::vector<double> spacing(kSpacing, kSpacing + 3);
  report.curve({"plate_re100", "spacing [chords]", "coefficient", "CL", spacing,
                std::vector<double>(lift, lift + 3), false});
  report.curve({"plate_re100", "spacing [chords]", "coefficient", "CD", spacing,
                std::vector<double>(drag, drag + 3), false});
}

}  // namespace monarch_flight::verify
