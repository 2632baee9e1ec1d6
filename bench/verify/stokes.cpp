// Stokes' first and second problem in the middle of a large plate: shear on both sides.
#include <algorithm>

#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

// The edges are out of reach, and so is the air that flows back round the plate for what the layers
// carry along: 0.1 m^2/s through 40 km of box.
constexpr double kViscosity = 0.01, kSize = 40000;  // [m^2/s], [m]
constexpr int kCells = 16;

Grid largePlate(double layer, int half_cells) {
  std::vector<std::uint8_t> wing(kCells * kCells, 0);
  for (int j = 2; j < kCells - 2; ++j)
    for (int i = 2; i < kCells - 2; ++i) wing[j * kCells + i] = 1;
  const Axis plane = uniformAxis(-kSize, kSize, kCells),
             z = coreAxis(layer, half_cells, 1.5, kSize);
  return makeGrid(plane, plane, z, z.n() / 2, false, wing);
}

/// Force per area and side in the middle of the plate, formed as the loads are.
double shear(const NavierStokes& flow, double wall) {
  const Grid& g = flow.grid();
  double sum = 0;
  for (int k : {g.k_wing - 1, g.k_wing}) {
    const double h = 0.5 * g.z.width[k];
    const double u = flow.velocity().c[0][flow.layout().at(kCells / 2, kCells / 2, k)];
    sum += kViscosity * (u - wall) / h;
  }
  return 0.5 * sum;
}

/// Largest error of the shear over [0.5, 1] of a plate set in motion at t = 0, relative.
double firstError(int half_cells, int steps) {
  NavierStokes flow(largePlate(9 * std::sqrt(kViscosity), half_cells), airOf(1, kViscosity), 1,
                    kNoCourantLimit);
  const double dt = 1.0 / steps;
  WingMotion m;
  m.v_W = Vector3d(1, 0, 0);
  flow.start(m, dt);
  double worst = 0;
  for (int s = 1; s <= steps; ++s) {
    flow.evaluate(m);
    flow.commit();
    const double exact = -std::sqrt(kViscosity / (M_PI * s * dt));
    if (2 * s >= steps) worst = std::max(worst, std::abs(shear(flow, 1) / exact - 1));
  }
  return worst;
}

/// Largest error of the shear over one period of an oscillating plate, by its amplitude. The air
/// begins with the periodic layer.
double secondError(int half_cells, int steps) {
  const double w = 2 * M_PI, k = std::sqrt(w / (2 * kViscosity));
  NavierStokes flow(largePlate(8 / k, half_cells), airOf(1, kViscosity), 1, kNoCourantLimit);
  const double dt = 1.0 / steps;
  auto motion = [&](double t) {
    WingMotion m;
    m.v_W = Vector3d(std::cos(w * t), 0, 0);
    m.a_W = Vector3d(-w * std::sin(w * t), 0, 0);
    return m;
  };
  flow.start(motion(0), dt);
  flow.setKnownFlow([&](const Vector3d& r, double t) {
    const double kz = k * std::abs(r.z());
    return Vector3d(std::exp(-kz) * std::cos(w * t - kz), 0, 0);
  });
  double worst = 0;
  for (int s = 1; s <= steps; ++s) {
    const double t = s * dt;
    flow.evaluate(motion(t));
    flow.commit();
    const double exact = kViscosity * k * (std::sin(w * t) - std::cos(w * t));
    const double found = shear(flow, std::cos(w * t));
    if (2 * s >= steps) worst = std::max(worst, std::abs(found - exact));
  }
  return worst / (kViscosity * k * std::sqrt(2));
}

void convergence(Report& report, const std::string& name, double (*error)(int, int)) {
  const int cells[3] = {32, 64, 128};
  std::vector<double> e;
  for (int n : cells) e.push_back(error(n, 3 * n));
  report.below(name + ": error of wall shear", "128 cells a side, 384 steps", e[2], 0.01);
  report.order(name + ": order", "64, 128 cells", std::log2(e[1] / e[2]), 1.9);
  report.curve({"stokes",
                "cells in the layer",
                "relative error of wall shear",
                name,
                {32, 64, 128},
                e,
                true});
}

}  // namespace

void stokes(Report& report) {
  convergence(report, "first problem", firstError);
  convergence(report, "second problem", secondError);
}

}  // namespace monarch_flight::verify
