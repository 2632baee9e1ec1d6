// Loads as an affine function of the interface's six velocities: predicted against re-solved.
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

Vector6d all(const Loads& l) {
  Vector6d f;
  f << l.force(), l.moment();
  return f;
}

WingMotion moved(WingMotion m, const Vector6d& du) {
  m.v_W += du.head<3>();
  m.omega_W += du.tail<3>();
  return m;
}

}  // namespace

void affine(Report& report) {
  GridSettings s = GridSettings::preset("preview");
  s.level = "custom";
  s.cells_per_chord = 12;
  s.courant_limit = kNoCourantLimit;
  const auto flow = makeNavierStokes(Planform::ellipse(1, 2, 0.3), airOf(1.2, 0.012), s);
  auto motion = [](double t) {
    return flapAndPitch(oscillation(0.6, 2 * M_PI, t), oscillation(0.5, 2 * M_PI, t, 1.5),
                        Vector3d(0.5, 0.1, 0));
  };
  const double dt = 0.005;
  flow->start(motion(0), dt);
  int step = 0;
  Vector6d scale;  // of the velocities
  scale << 1, 1, 1, 2, 2, 2;
  for (int instant : {1, 10, 40, 70}) {
    for (; step < instant; ++step) {
      flow->evaluate(motion((step + 1) * dt));
      flow->commit();
    }
    const WingMotion base = motion((step + 1) * dt);
    const Vector6d f0 = all(flow->evaluate(base));
    Matrix6d K;
    for (int i = 0; i < 6; ++i)
      K.col(i) = (all(flow->evaluate(moved(base, scale[i] * Vector6d::Unit(i)))) - f0) / scale[i];
    double worst = 0;
    for (int i = 0; i < 6; ++i) {
      Vector6d du = -0.37 * scale[i] * Vector6d::Unit(i);
      du[(i + 2) % 6] += 0.21;
      const Vector6d found = all(flow->evaluate(moved(base, du)));
      worst = std::max(worst, (f0 + K * du - found).norm() / found.norm());
    }
    report.below("predicted - re-solved loads", text("step %g, six directions", instant), worst,
                 1e-9);
  }
}

}  // namespace monarch_flight::verify
