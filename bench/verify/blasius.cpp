// Friction of a plate at zero incidence, at mid-span away from the edges, against Blasius.
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

constexpr double kViscosity = 1e-3;  // the plate moves with speed 1: Re_x = 1000 x

/// Friction of both sides by that of Blasius' layer, over the distance from the leading edge.
Curve friction(double length, int cells) {
  const double growth = 1.2, span = 1.5;
  const Axis x = coreAxis(0.5 * length, static_cast<int>(0.5 * length * cells), growth, 6);
  const Axis y = coreAxis(span / 2, 8, 1.4, 6), z = coreAxis(0.1, cells / 4, growth, 6);
  std::vector<std::uint8_t> wing;
  for (double b : y.centre)
    for (double a : x.centre) wing.push_back(std::abs(a) < 0.5 * length && std::abs(b) < span / 2);
  NavierStokes flow(makeGrid(x, y, z, z.n() / 2, false, wing), airOf(1, kViscosity), 1,
                    kNoCourantLimit);
  auto motion = [](double t) {
    WingMotion m;
    m.v_W = Vector3d(1, 0, 0);
    m.r_I = Vector3d(t, 0, 0);
    return m;
  };
  const double dt = 0.8 / cells, duration = 3 + length;
  fly(flow, motion, dt, static_cast<int>(std::lround(duration / dt)));
  Curve curve{"blasius",
              "Re_x / 1000",
              "friction / Blasius",
              text("length %g, %g cells a unit", length, cells),
              {},
              {},
              false};
  const int j = y.n() / 2, k = z.n() / 2;
  for (int i = 1; i < x.n(); ++i) {
    const double from_edge = 0.5 * length - x.face[i];  // the leading edge is the forward one
    if (from_edge < 0.05 || from_edge > 0.95 * length) continue;
    double tau = 0;
    for (int side : {k - 1, k}) {
      const double u = flow.velocity().c[0][flow.layout().at(i, j, side)];
      tau += kViscosity * (1 - u) / (0.5 * z.width[side]);
    }
    curve.x.push_back(from_edge);
    curve.y.push_back(tau / (0.664 * std::sqrt(kViscosity / from_edge)));
  }
  return curve;
}

double mean(const Curve& c, double low, double high) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    if (c.x[i] < low || c.x[i] > high) continue;
    sum += c.y[i];
    ++count;
  }
  return sum / count;
}

}  // namespace

void blasius(Report& report) {
  for (int cells : {20, 28}) {
    const Curve curve = friction(4, cells);
    report.near("friction at Re_x 0.8 - 1.2e3, Re 4000", text("%g cells a unit", cells),
                mean(curve, 0.8, 1.2), 1, 0.03);
    report.curve(curve);
  }
  const Curve curve = friction(1, 32);  // here the trailing edge is felt everywhere
  report.state("friction at Re_x 300 - 700, Re 1000", "32 cells a unit", mean(curve, 0.3, 0.7), 1);
  report.curve(curve);
}

}  // namespace monarch_flight::verify
