// The wing's loads during a flap against the momentum balance over a surrounding box.
#include <algorithm>

#include "verify/momentum_box.h"
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

/// Distance of the box from the wing [chords]: where the cells are still small, for what flows
/// through its faces is itself interpolated.
constexpr double kAround = 0.2;

int indexOf(const Axis& axis, double at) {
  return static_cast<int>(std::lower_bound(axis.face.begin(), axis.face.end(), at) -
                          axis.face.begin());
}

/// Root mean square and largest difference of the normal force, by its peak.
void compare(Report& report, double cells_per_chord, bool bounded, std::vector<double>& worst) {
  GridSettings s = GridSettings::preset("preview");
  s.level = "custom";
  s.cells_per_chord = cells_per_chord;
  s.first_cell = 0.48 / cells_per_chord;
  s.growth_normal = s.growth_plane = 1 + 3.2 / cells_per_chord;
  s.margin = 0.6;
  s.far_field = 6;
  const double rho = 1.2, mu = 0.012, dt = 0.08 / cells_per_chord, w = 2 * M_PI;
  NavierStokes flow(makeGrid(Planform::rectangle(1, 2, 0.3, 0.5), s), airOf(rho, mu), 1,
                    kNoCourantLimit);
  const Grid& g = flow.grid();
  const int low[3] = {indexOf(g.x, -0.7 - kAround), indexOf(g.y, 0.5 - kAround),
                      indexOf(g.z, -kAround)};
  const int high[3] = {indexOf(g.x, 0.3 + kAround), indexOf(g.y, 2.5 + kAround),
                       indexOf(g.z, kAround)};
  const Box box(flow, low, high, rho, mu);
  auto motion = [&](double t) {
    return flapAndPitch(oscillation(0.5, w, t), oscillation(0.4, w, t, M_PI / 2));
  };
  flow.start(motion(0), dt);
  std::vector<Vector3d> P{flow.axes() * box.momentum()};
  const int steps = static_cast<int>(std::lround(0.5 / dt));
  double peak = 0, largest = 0, sum = 0;
  int count = 0;
  Vector3d loads[2], flux[2];  // of the last level and the one before, inertial axes
  for (int n = 1; n <= steps; ++n) {
    const WingMotion m = motion(n * dt);
    loads[0] = loads[1], flux[0] = flux[1];
    loads[1] = m.R_IW * flow.evaluate(m).force();
    flow.commit();
    P.push_back(flow.axes() * box.momentum());
    flux[1] = flow.axes() * box.inflow({m.v_W, m.omega_W});
    if (n * dt < 0.1) continue;  // set in motion at once: the friction begins without bound
    // At the level before, whose dP/dt is a central difference.
    const Vector3d balance = flux[0] - (P[n] - P[n - 2]) / (2 * dt);
    const double difference = (balance - loads[0]).norm();
    peak = std::max(peak, loads[0].norm());
    largest = std::max(largest, difference);
    sum += difference * difference;
    ++count;
  }
  const std::string resolution = text("%g cells a chord", cells_per_chord);
  const char* name = "largest difference / peak force";
  if (bounded) {
    report.below(name, resolution, largest / peak, 0.01);
  } else {
    report.state(name, resolution, largest / peak, 0);
  }
  report.state("rms difference / peak force", resolution, std::sqrt(sum / count) / peak, 0);
  worst.push_back(largest / peak);
}

}  // namespace

void momentumBalance(Report& report) {
  std::vector<double> worst;
  for (double cells : {12.0, 16.0, 24.0}) compare(report, cells, cells == 24, worst);
  report.curve({"momentum_balance",
                "cells a chord",
                "largest difference / peak force",
                "force vector",
                {12, 16, 24},
                worst,
                true});
}

}  // namespace monarch_flight::verify
