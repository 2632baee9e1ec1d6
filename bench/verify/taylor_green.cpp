// Decaying Taylor-Green vortices on a grid at rest and on one that translates and turns.
#include <vector>

#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

constexpr double kViscosity = 0.02, kWaves = M_PI;

Vector3d vortices(const Vector3d& r, double t) {
  const double decay = std::exp(-2 * kViscosity * kWaves * kWaves * t);
  return decay * Vector3d(std::sin(kWaves * r.x()) * std::cos(kWaves * r.y()),
                          -std::cos(kWaves * r.x()) * std::sin(kWaves * r.y()), 0);
}

WingMotion motionOf(double t, bool moving) {
  WingMotion m;
  const Vector3d omega(0.6, -0.4, 0.9), V(0.3, 0.2, -0.25);
  m.R_IW = expSO3(omega * (moving ? t : 0.5));  // at rest in a skew attitude, too
  if (!moving) return m;
  m.omega_W = omega;
  m.r_I = V * t;
  m.v_W = m.R_IW.transpose() * V;
  return m;
}

/// Velocities after time 1 on n^3 cells minus the exact ones, in the inner half of the box: through
/// the outer boundary the solver expects air near rest to pass, not vortices.
std::vector<double> errors(int n, int steps, bool moving) {
  const Axis axis = uniformAxis(-1, 1, n);
  NavierStokes flow(makeGrid(axis, axis, axis, n / 2, false,
                             std::vector<std::uint8_t>(static_cast<std::size_t>(n) * n, 0)),
                    airOf(1, kViscosity), 1, kNoCourantLimit);
  const double T = 1, dt = T / steps;
  flow.start(motionOf(0, moving), dt);
  flow.setKnownFlow(vortices);
  for (int s = 1; s <= steps; ++s) {
    flow.evaluate(motionOf(s * dt, moving));
    flow.commit();
  }
  const WingMotion m = motionOf(T, moving);
  std::vector<double> e;
  const int a = n / 4, b = n - n / 4;
  for (int c = 0; c < 3; ++c)
    for (int k = a; k < b; ++k)
      for (int j = a; j < b; ++j)
        for (int i = a; i < b; ++i) {
          const Vector3d r(c == 0 ? axis.face[i] : axis.centre[i],
                           c == 1 ? axis.face[j] : axis.centre[j],
                           c == 2 ? axis.face[k] : axis.centre[k]);
          const Vector3d exact = flow.axes().transpose() * vortices(m.r_I + m.R_IW * r, T);
          e.push_back(flow.velocity().c[c][flow.layout().at(i, j, k)] - exact[c]);
        }
  return e;
}

double rms(const std::vector<double>& a, const std::vector<double>* b = nullptr) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = b ? a[i] - (*b)[i] : a[i];
    sum += d * d;
  }
  return std::sqrt(sum / a.size());
}

}  // namespace

void taylorGreen(Report& report) {
  double error[2][3];
  for (bool moving : {false, true}) {
    const std::string grid = moving ? "moving grid" : "grid at rest";
    const int cells[3] = {12, 24, 48};
    for (int i = 0; i < 3; ++i) {
      error[moving][i] = rms(errors(cells[i], 8 * cells[i] / 3, moving));
      report.state(grid + ": rms error", text("%g^3 cells, %g steps", cells[i], 8 * cells[i] / 3),
                   error[moving][i], 0);
    }
    report.order(grid + ": order, space and time", "24, 48 cells",
                 std::log2(error[moving][1] / error[moving][2]), 1.9);
    report.curve({"taylor_green",
                  "cells a side",
                  "rms error of velocity",
                  grid,
                  {12, 24, 48},
                  {error[moving][0], error[moving][1], error[moving][2]},
                  true});

    const int n = 24;  // time alone: against a run with a quarter of the finest step
    const std::vector<double> best = errors(n, 512, moving);
    const double a = rms(errors(n, 64, moving), &best), b = rms(errors(n, 128, moving), &best);
    report.order(grid + ": order in time", "64, 128 steps, 24^3 cells", std::log2(a / b), 1.9);
    report.curve(
        {"taylor_green_time", "steps", "rms of time error", grid, {64, 128}, {a, b}, true});
  }
  report.below("moving / fixed error", "48^3 cells", error[1][2] / error[0][2], 2);
}

}  // namespace monarch_flight::verify
