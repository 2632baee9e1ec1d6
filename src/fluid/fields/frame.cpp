#include "fluid/fields/frame.h"

#include <algorithm>

namespace monarch_flight::fluid {

GridVelocity gridVelocity(const WingMotion& motion) { return {motion.v_W, motion.omega_W}; }

WallVelocity wallVelocity(const GridVelocity& g) {
  WallVelocity w;
  for (int c = 0; c < 3; ++c) {
    w.c0[c] = g.V[c];
    w.cx[c] = g.at(c, 1, 0, 0) - g.V[c];
    w.cy[c] = g.at(c, 0, 1, 0) - g.V[c];
  }
  return w;
}

WallVelocity rotated(const WallVelocity& w, const Eigen::Matrix3d& Q) {
  using Map = Eigen::Map<const Eigen::Vector3d>;
  WallVelocity r;
  Eigen::Map<Eigen::Vector3d>(r.c0) = Q * Map(w.c0);
  Eigen::Map<Eigen::Vector3d>(r.cx) = Q * Map(w.cx);
  Eigen::Map<Eigen::Vector3d>(r.cy) = Q * Map(w.cy);
  return r;
}

WallVelocity combined(double a, const WallVelocity& x, double b, const WallVelocity& y, double c,
                      const WallVelocity& z) {
  WallVelocity r;
  for (int i = 0; i < 3; ++i) {
    r.c0[i] = a * x.c0[i] + b * y.c0[i] + c * z.c0[i];
    r.cx[i] = a * x.cx[i] + b * y.cx[i] + c * z.cx[i];
    r.cy[i] = a * x.cy[i] + b * y.cy[i] + c * z.cy[i];
  }
  return r;
}

namespace {

/// Row (j, k) of component c.
void rotateRow(const Layout& l, const Eigen::Matrix3d& Q, int c, int j, int k, const Velocity& in,
               Velocity& out) {
  const int d = (c + 1) % 3, e = (c + 2) % 3;
  const double qc = Q(c, c), qd = 0.25 * Q(c, d), qe = 0.25 * Q(c, e);
  const std::ptrdiff_t sc = l.stride(c), sd = l.stride(d), se = l.stride(e), row = l.at(0, j, k);
  const double* __restrict a = in.c[c].data() + row;
  const double* __restrict b = in.c[d].data() + row;
  const double* __restrict g = in.c[e].data() + row;
  double* __restrict o = out.c[c].data() + row;
#pragma omp simd
  for (int i = c == 0; i < l.nx; ++i) {
    const double mean_d = b[i] + b[i - sc] + b[i + sd] + b[i + sd - sc];
    const double mean_e = g[i] + g[i - sc] + g[i + se] + g[i + se - sc];
    o[i] = qc * a[i] + qd * mean_d + qe * mean_e;
  }
}

}  // namespace

void rotateField(const Layout& l, const Team& team, const Eigen::Matrix3d& Q, const Velocity& in,
                 Velocity& out) {
  team.each(l.k0, l.k1, [&](int k, int) {
    for (int j = 0; j < l.ny; ++j) {
      rotateRow(l, Q, 0, j, k, in, out);
      if (j > 0) rotateRow(l, Q, 1, j, k, in, out);
      if (k > 0) rotateRow(l, Q, 2, j, k, in, out);
    }
  });
}

Eigen::Isometry3d placeOf(const WingMotion& motion) {
  Eigen::Isometry3d place;
  place.linear() = motion.R_IW;
  place.translation() = motion.r_I;
  return place;
}

}  // namespace monarch_flight::fluid
