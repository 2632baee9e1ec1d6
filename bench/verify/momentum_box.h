#pragma once
#include "fluid/flow/flow.h"

namespace monarch_flight::verify {

using namespace fluid;

/// Balance over the cells [low, high) of the committed field, in its axes.
class Box {
 public:
  Box(const NavierStokes& flow, const int low[3], const int high[3], double rho, double mu)
      : f_(flow), g_(flow.grid()), rho_(rho), mu_(mu) {
    for (int d = 0; d < 3; ++d) low_[d] = low[d], high_[d] = high[d];
  }
  Eigen::Vector3d momentum() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = low_[2]; k < high_[2]; ++k)
      for (int j = low_[1]; j < high_[1]; ++j)
        for (int i = low_[0]; i < high_[0]; ++i)
          sum += rho_ * g_.x.width[i] * g_.y.width[j] * g_.z.width[k] * centre(i, j, k);
    return sum;
  }
  /// Pressure, stress and momentum that enter through the faces, which move with the grid.
  Eigen::Vector3d inflow(const GridVelocity& grid) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
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
  double v(int c, int i, int j, int k) const { return f_.velocity().c[c][f_.layout().at(i, j, k)]; }
  Eigen::Vector3d centre(int i, int j, int k) const {
    return 0.5 * Eigen::Vector3d(v(0, i, j, k) + v(0, i + 1, j, k),
                                 v(1, i, j, k) + v(1, i, j + 1, k),
                                 v(2, i, j, k) + v(2, i, j, k + 1));
  }
  /// What the face d of the cell q gives to the air on its lower side.
  Eigen::Vector3d face(int d, const int q[3], const GridVelocity& grid) const {
    int low[3] = {q[0], q[1], q[2]};
    --low[d];
    const double area =
        axis((d + 1) % 3).width[q[(d + 1) % 3]] * axis((d + 2) % 3).width[q[(d + 2) % 3]];
    const double gap = axis(d).gap[q[d]], share = 0.5 * axis(d).width[low[d]] / gap;
    const Eigen::Vector3d a = centre(low[0], low[1], low[2]), b = centre(q[0], q[1], q[2]);
    Eigen::Vector3d u = a + share * (b - a);
    u[d] = v(d, q[0], q[1], q[2]);
    Eigen::Vector3d r(g_.x.centre[q[0]], g_.y.centre[q[1]], g_.z.centre[q[2]]);
    r[d] = axis(d).face[q[d]];
    const double flux = u[d] - grid.at(d, r.x(), r.y(), r.z());
    const Layout& l = f_.layout();
    const double p0 = f_.pressure()[l.at(low[0], low[1], low[2])];
    const double p1 = f_.pressure()[l.at(q[0], q[1], q[2])];
    Eigen::Vector3d t =
        mu_ * (b - a) / gap - rho_ * flux * u;  // the other half of the stress integrates
    t[d] -= p0 + share * (p1 - p0);             // to nothing over a closed surface
    return area * t;
  }

  const NavierStokes& f_;
  const Grid& g_;
  int low_[3], high_[3];
  double rho_, mu_;
};

}  // namespace monarch_flight::verify
