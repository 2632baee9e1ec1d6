// A uniform stream through a grid without a wing that translates and turns once.
#include <algorithm>

#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {

void uniformStream(Report& report) {
  const int n = 24, steps = 200;
  const double dt = 0.01;
  NavierStokes flow(
      makeGrid(
          coreAxis(0.5, n / 4, 1.15, 1.5), coreAxis(0.5, n / 4, 1.1, 1.5),
          coreAxis(0.3, n / 4, 1.2, 1.5), coreAxis(0.3, n / 4, 1.2, 1.5).n() / 2, false,
          std::vector<std::uint8_t>(static_cast<std::size_t>(coreAxis(0.5, n / 4, 1.15, 1.5).n()) *
                                        coreAxis(0.5, n / 4, 1.1, 1.5).n(),
                                    0)),
      airOf(1.2, 0.012), 1, kNoCourantLimit);
  const Vector3d omega = Vector3d(1, 2, -2).normalized() * (2 * M_PI / (steps * dt));
  const Vector3d V(1, -2, 0.5), stream(0.3, -0.7, 1.1);
  auto motion = [&](int step) {
    WingMotion m;
    m.R_IW = expSO3(omega * (step * dt));
    m.r_I = V * (step * dt);
    m.omega_W = omega;  // along a fixed axis: the same in both frames
    m.v_W = m.R_IW.transpose() * V;
    return m;
  };
  flow.start(motion(0), dt);
  flow.setKnownFlow([&](const Vector3d&, double) { return stream; });
  double worst = 0;
  const Layout& l = flow.layout();
  for (int s = 1; s <= steps; ++s) {
    flow.evaluate(motion(s));
    flow.commit();
    const Vector3d expected = flow.axes().transpose() * stream;
    for (int k = 0; k < l.nz; ++k)
      for (int j = 0; j < l.ny; ++j)
        for (int i = 0; i < l.nx; ++i)
          for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(flow.velocity().c[c][l.at(i, j, k)] - expected[c]));
  }
  report.below("largest deviation, one full turn", text("%g cells, 200 steps", flow.cells()),
               worst / stream.norm(), 1e-10);
}

}  // namespace monarch_flight::verify
