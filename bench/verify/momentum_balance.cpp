// The wing's loads during a flap against the momentum balance over a surrounding box.
#include <algorithm>

#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

/// Balance over the cells [low, high) of the committed field, wing axes.
class Box {
 public:
  Box(const NavierStokes& flow, const int low[3], const int high[3], double rho, double mu)
      : f_(flow), g_(flow.grid()), rho_(rho), mu_(mu) {
    for (int d = 0; d < 3; ++d) low_[d] = low[d], high_[d] = high[d];
  }
  Vector3d momentum() const {
    Vector3d sum = Vector3d::Zero();
    for (int k = low_[2]; k < high_[2]; ++k)
      for (int j = low_[1]; j < high_[1]; ++j)
        for (int i = low_[0]; i < high_[0]; ++i)
          sum += rho_ * g_.x.width[i] * g_.y.width[j] * g_.z.width[k] * centre(i, j, k);
    return sum;
  }
  /// Pressure, stress and momentum that enter through the faces, which move with the grid.
  Vector3d inflow(const GridVelocity& grid) const {
    Vector3d sum = Vector3d::Zero();
    int q[3];
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3, h = (d + 2) % 3;
      for (int side : {0, 1}) {
        q[d] = side ? high_[d] : low_[d];
        for (q[e] = low_[e]; q[e] < high_[e]; ++q[e])
          for (q[h] = low_[h]; q[h] < high_[h]; ++q[h]) sum += (side ? 1 : -1) * face(d, q, grid);
      }
    }
    return sum;
  }

 private:
  const Axis& axis(int d) const { return d == 0 ? g_.x : d == 1 ? g_.y : g_.z; }
  double v(int c, int i, int j, int k) const {
    return f_.velocity().c[c][f_.layout().at(i, j, k)];
  }
  Vector3d centre(int i, int j, int k) const {
    return 0.5 * Vector3d(v(0, i, j, k) + v(0, i + 1, j, k), v(1, i, j, k) + v(1, i, j + 1, k),
                          v(2, i, j, k) + v(2, i, j, k + 1));
  }
  /// What the face d of the cell q gives to the air on its lower side.
  Vector3d face(int d, const int q[3], const GridVelocity& grid) const {
    int low[3] = {q[0], q[1], q[2]};
    --low[d];
    const double area = axis((d + 1) % 3).width[q[(d + 1) % 3]] *
                        axis((d + 2) % 3).width[q[(d + 2) % 3]];
    const double gap = axis(d).gap[q[d]], share = 0.5 * axis(d).width[low[d]] / gap;
    const Vector3d a = centre(low[0], low[1], low[2]), b = centre(q[0], q[1], q[2]);
    Vector3d u = a + share * (b - a);
    u[d] = v(d, q[0], q[1], q[2]);
    Vector3d r(g_.x.centre[q[0]], g_.y.centre[q[1]], g_.z.centre[q[2]]);
    r[d] = axis(d).face[q[d]];
    const double flux = u[d] - grid.at(d, r.x(), r.y(), r.z());
    const Layout& l = f_.layout();
    const double p0 = f_.pressure()[l.at(low[0], low[1], low[2])];
    const double p1 = f_.pressure()[l.at(q[0], q[1], q[2])];
    Vector3d t = mu_ * (b - a) / gap - rho_ * flux * u;  // the other half of the stress integrates
    t[d] -= p0 + share * (p1 - p0);                      // to nothing over a closed surface
    return area * t;
  }

  const NavierStokes& f_;
  const Grid& g_;
  int low_[3], high_[3];
  double rho_, mu_;
};

int indexOf(const Axis& axis, double at) {
  return static_cast<int>(std::lower_bound(axis.face.begin(), axis.face.end(), at) -
                          axis.face.begin());
}

/// Root mean square and largest difference of the normal force, by its peak.
void compare(Report& report, double cells_per_chord, std::vector<double>& worst) {
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
  const int low[3] = {indexOf(g.x, -1.1), indexOf(g.y, 0.1), indexOf(g.z, -0.4)};
  const int high[3] = {indexOf(g.x, 0.7), indexOf(g.y, 2.9), indexOf(g.z, 0.4)};
  const Box box(flow, low, high, rho, mu);
  auto motion = [&](double t) {
    return flapAndPitch(oscillation(0.5, w, t), oscillation(0.4, w, t, M_PI / 2));
  };
  flow.start(motion(0), dt);
  std::vector<Vector3d> P{motion(0).R_IW * box.momentum()};
  const int steps = static_cast<int>(std::lround(0.5 / dt));
  double peak = 0, largest = 0, sum = 0;
  int count = 0;
  Vector3d loads[2], flux[2];  // of the last level and the one before, inertial axes
  for (int n = 1; n <= steps; ++n) {
    const WingMotion m = motion(n * dt);
    loads[0] = loads[1], flux[0] = flux[1];
    loads[1] = m.R_IW * flow.evaluate(m).force();
    flow.commit();
    P.push_back(m.R_IW * box.momentum());
    flux[1] = m.R_IW * box.inflow({m.v_W, m.omega_W});
    if (n < 6) continue;  // dP/dt at the level before, by central differences
    const Vector3d balance = flux[0] - (P[n] - P[n - 2]) / (2 * dt);
    const double difference = (balance - loads[0]).norm();
    peak = std::max(peak, loads[0].norm());
    largest = std::max(largest, difference);
    sum += difference * difference;
    ++count;
  }
  const std::string resolution = text("%g cells a chord", cells_per_chord);
  report.below("largest difference / peak force", resolution, largest / peak, 0.01);
  report.state("rms difference / peak force", resolution, std::sqrt(sum / count) / peak, 0);
  worst.push_back(largest / peak);
}

}  // namespace

void momentumBalance(Report& report) {
  std::vector<double> worst;
  for (double cells : {12.0, 16.0, 24.0}) compare(report, cells, worst);
  report.curve({"momentum_balance", "cells a chord", "largest difference / peak force",
                "force vector", {12, 16, 24}, worst, true});
}

}  // namespace monarch_flight::verify
