// Friction of a plate at zero incidence, Re 1000, at mid-span away from the edges, against Blasius.
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {

void blasius(Report& report) {
  const double nu = 1e-3, growth = 1.2, span = 1.5;
  for (int n : {32, 48}) {
    const Axis x = coreAxis(0.5, n / 2, growth, 6), y = coreAxis(span / 2, 8, 1.4, 6);
    const Axis z = coreAxis(0.1, n / 4, growth, 6);
    std::vector<std::uint8_t> wing;
    for (double b : y.centre)
      for (double a : x.centre) wing.push_back(std::abs(a) < 0.5 && std::abs(b) < span / 2);
    NavierStokes flow(makeGrid(x, y, z, z.n() / 2, false, wing), airOf(1, nu), 1, kNoCourantLimit);
    auto motion = [](double t) {
      WingMotion m;
      m.v_W = Vector3d(1, 0, 0);
      m.r_I = Vector3d(t, 0, 0);
      return m;
    };
    const double dt = 0.8 / n;
    fly(flow, motion, dt, static_cast<int>(std::lround(4 / dt)));
    double drag = 0, exact = 0;
    Curve curve{"blasius", "x / chord", "friction coefficient", text("%g cells a chord", n), {}, {},
                false};
    Curve theory{"blasius", "x / chord", "friction coefficient", "Blasius", {}, {}, false};
    const int j = y.n() / 2, k = z.n() / 2;
    for (int i = 1; i < x.n(); ++i) {
      const double from_edge = 0.5 - x.face[i];  // the leading edge is at x = +0.5
      if (from_edge < 0.05 || from_edge > 0.95) continue;
      double tau = 0;  // both sides
      for (int side : {k - 1, k}) {
        const double u = flow.velocity().c[0][flow.layout().at(i, j, side)];
        tau += nu * (1 - u) / (0.5 * z.width[side]);
      }
      const double cf = 0.664 * std::sqrt(nu / from_edge);
      curve.x.push_back(from_edge);
      curve.y.push_back(tau);  // 2 tau / (rho U^2), mean of two sides
      theory.x.push_back(from_edge);
      theory.y.push_back(cf);
      if (from_edge < 0.3 || from_edge > 0.7) continue;
      drag += tau;
      exact += cf;
    }
    report.near("friction, 0.3 to 0.7 chords", text("%g cells a chord", n), drag, exact, 0.03);
    report.curve(std::move(curve));
    if (n == 48) report.curve(std::move(theory));
  }
}

}  // namespace monarch_flight::verify
