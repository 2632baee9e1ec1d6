// The edge of the wing: loads of a flapping, a heaving and a pitching plate on three grids.
#include <algorithm>

#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

constexpr double kOmega = 2 * M_PI, kStandard = 28;

struct Case {
  const char* name;
  Planform planform;
  Motion motion;
};

struct Peaks {
  double force, moment;  ///< root mean square over half a period, begun at a tenth
};

/// `standard` with everything scaled to another resolution; the time step, too.
Peaks measure(const Case& c, double cells, std::vector<double>& F_z) {
  GridSettings s = GridSettings::preset("standard");
  const double finer = cells / kStandard;
  s.level = "custom";
  s.cells_per_chord = cells;
  s.first_cell /= finer;
  s.growth_plane = s.growth_normal = 1 + (s.growth_plane - 1) / finer;
  s.far_field = 6;
  s.courant_limit = kNoCourantLimit;
  const auto flow = makeNavierStokes(c.planform, airOf(1, 0.02), s);
  const int steps = static_cast<int>(std::lround(0.6 * 10 * cells));
  const auto loads = fly(*flow, c.motion, 0.6 / steps, steps);
  Peaks p{0, 0};
  const int begin = steps / 6;
  for (int n = 0; n < steps; ++n) {
    F_z.push_back(loads[n].force().z());
    if (n < begin) continue;
    p.force += std::pow(loads[n].force().z(), 2);
    p.moment += std::pow(loads[n].moment().y(), 2);
  }
  return {std::sqrt(p.force / (steps - begin)), std::sqrt(p.moment / (steps - begin))};
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
  const double cells[3] = {14, 20, kStandard}, h[3] = {1 / 14.0, 1 / 20.0, 1 / kStandard};
  for (const Case& c : cases) {
    double force[3], moment[3];
    for (int i = 0; i < 3; ++i) {
      std::vector<double> F_z;
      const Peaks p = measure(c, cells[i], F_z);
      force[i] = p.force, moment[i] = p.moment;
      const std::string resolution = text("%g cells a chord", cells[i]);
      report.state(std::string(c.name) + ": F_z, rms", resolution, p.force, 0);
      report.state(std::string(c.name) + ": M_y, rms", resolution, p.moment, 0);
    }
    const Extrapolated f = extrapolate(h, force), m = extrapolate(h, moment);
    report.near(std::string(c.name) + ": F_z of standard", "14, 20, 28 cells", force[2], f.value,
                0.03);
    report.near(std::string(c.name) + ": M_y of standard", "14, 20, 28 cells", moment[2], m.value,
                0.05);
    report.state(std::string(c.name) + ": order of F_z, of M_y", "14, 20, 28 cells", f.order,
                 m.order);
    Curve curve{"rim", "spacing [chords]", "rms F_z / extrapolated", c.name, {}, {}, false};
    for (int i = 0; i < 3; ++i) curve.x.push_back(h[i]), curve.y.push_back(force[i] / f.value);
    report.curve(std::move(curve));
    Curve moments{"rim_moment", "spacing [chords]", "rms M_y / extrapolated", c.name, {}, {},
                  false};
    for (int i = 0; i < 3; ++i) moments.x.push_back(h[i]), moments.y.push_back(moment[i] / m.value);
    report.curve(std::move(moments));
  }
}

}  // namespace monarch_flight::verify
