#include "fluid/fields/projection.h"

#include <algorithm>
#include <cmath>

namespace monarch_flight::fluid {

void netOutflow(const Grid& grid, const Layout& l, const Team& team, const Velocity& v,
                double scale, double* b) {
  const double* hx = grid.x.width.data();
  team.each(l.k0, l.k1, [&](int k, int) {
    for (int j = 0; j < l.ny; ++j) {
      const double hy = scale * grid.y.width[j], hz = grid.z.width[k];
      const std::ptrdiff_t row = l.at(0, j, k), sy = l.sy, sz = l.sz;
      const double* __restrict u = v.c[0].data() + row;
      const double* __restrict s = v.c[1].data() + row;
      const double* __restrict w = v.c[2].data() + row;
      double* __restrict o = b + (static_cast<std::ptrdiff_t>(k - l.k0) * l.ny + j) * l.nx;
      const double ax = hy * hz, ay = scale * hz;
#pragma omp simd
      for (int i = 0; i < l.nx; ++i) {
        o[i] = ax * (u[i + 1] - u[i]) + hx[i] * (ay * (s[i + sy] - s[i]) + hy * (w[i + sz] - w[i]));
      }
    }
  });
}

namespace {

/// v -= m grad (m = 1: null) of a row, the difference `s` apart; `scale` by 1 / gap: of each point
/// along x, of the row across it.
void subtractDifference(int i0, int nx, const double* q, std::ptrdiff_t s, double scale,
                        const double* gap, const double* mobility, double* v) {
  if (mobility == nullptr) {
#pragma omp simd
    for (int i = i0; i < nx; ++i) v[i] -= (gap ? scale / gap[i] : scale) * (q[i] - q[i - s]);
    return;
  }
  for (int i = i0; i < nx; ++i)
    v[i] -= mobility[i] * (gap ? scale / gap[i] : scale) * (q[i] - q[i - s]);
}

}  // namespace

void subtractGradient(const Grid& grid, const Layout& l, const Team& team, const double* phi,
                      double scale, Velocity& v) {
  const std::ptrdiff_t py = l.nx, pz = static_cast<std::ptrdiff_t>(l.nx) * l.ny;
  team.each(l.k0, l.k1, [&](int k, int) {
    for (int j = 0; j < l.ny; ++j) {
      const std::ptrdiff_t row = l.at(0, j, k);
      const double* q = phi + (k - l.k0) * pz + j * py;
      const auto mobility = [&](int c) { return grid.mobility.row(c, j, k); };
      subtractDifference(1, l.nx, q, 1, scale, grid.x.gap.data(), mobility(0), v.c[0].data() + row);
      if (j > 0) {
        subtractDifference(0, l.nx, q, py, scale / grid.y.gap[j], nullptr, mobility(1),
                           v.c[1].data() + row);
      }
      if (k > 0) {
        subtractDifference(0, l.nx, q, pz, scale / grid.z.gap[k], nullptr, mobility(2),
                           v.c[2].data() + row);
      }
    }
  });
  if (!grid.open) return;
  auto cell = [&](int i, int j, int k) { return phi[(k - l.k0) * pz + j * py + i]; };
  for (int k = l.k0; k < l.k1; ++k) {
    for (int j = 0; j < l.ny; ++j) {
      v.c[0][l.at(0, j, k)] -= scale / grid.x.gap[0] * cell(0, j, k);
      v.c[0][l.at(l.nx, j, k)] += scale / grid.x.gap[l.nx] * cell(l.nx - 1, j, k);
    }
    for (int i = 0; i < l.nx; ++i) {
      v.c[1][l.at(i, 0, k)] -= scale / grid.y.gap[0] * cell(i, 0, k);
      v.c[1][l.at(i, l.ny, k)] += scale / grid.y.gap[l.ny] * cell(i, l.ny - 1, k);
    }
  }
  for (int j = 0; j < l.ny; ++j) {
    for (int i = 0; i < l.nx; ++i) {
      if (l.k0 == 0) v.c[2][l.at(i, j, 0)] -= scale / grid.z.gap[0] * cell(i, j, 0);
      if (l.k1 == l.nz) v.c[2][l.at(i, j, l.nz)] += scale / grid.z.gap[l.nz] * cell(i, j, l.nz - 1);
    }
  }
}

namespace {

/// Calls f(outer point, inner point, indices of the outer point) for the outer faces or ghosts of
/// component c, direction d, on the planes of this process and on its neighbouring planes.
template <class F>
void forOuter(const Layout& l, int c, int d, F f) {
  const int lo[3] = {-1, -1, l.k0 - 1}, hi[3] = {l.nx, l.ny, l.k1};
  const std::ptrdiff_t s = l.stride(d);
  const int low = c == d ? 0 : -1, high = l.n(d);
  const int e = (d + 1) % 3, g = (d + 2) % 3;
  const bool has_low = d != 2 || l.k0 == 0, has_high = d != 2 || l.k1 == l.nz;
  int q[3];
  for (q[g] = lo[g]; q[g] <= hi[g]; ++q[g]) {
    for (q[e] = lo[e]; q[e] <= hi[e]; ++q[e]) {
      q[d] = low;
      const std::ptrdiff_t a = has_low ? l.at(q[0], q[1], q[2]) : 0;
      if (has_low) f(a, a + s, q);
      q[d] = high;
      const std::ptrdiff_t b = has_high ? l.at(q[0], q[1], q[2]) : 0;
      if (has_high) f(b, b - s, q);
    }
  }
}

}  // namespace

void fillOuter(const Grid& grid, const Layout& l, Velocity& v) {
  for (int c = 0; c < 3; ++c) {
    double* a = v.c[c].data();
    for (int d = 0; d < 3; ++d) {
      if (grid.open) {
        forOuter(l, c, d, [a](std::ptrdiff_t outer, std::ptrdiff_t inner, const int*) {
          a[outer] = a[inner];
        });
      } else {
        forOuter(l, c, d, [a](std::ptrdiff_t outer, std::ptrdiff_t, const int*) { a[outer] = 0; });
      }
    }
  }
}

Eigen::Vector3d pointOf(const Grid& grid, int component, int i, int j, int k) {
  const Axis* axes[3] = {&grid.x, &grid.y, &grid.z};
  const int q[3] = {i, j, k};
  Eigen::Vector3d r;
  for (int d = 0; d < 3; ++d) {
    const Axis& a = *axes[d];
    r[d] = d == component  ? a.face[std::min(std::max(q[d], 0), a.n())]
           : q[d] < 0      ? a.face.front()
           : q[d] >= a.n() ? a.face.back()
                           : a.centre[q[d]];
  }
  return r;
}

void fillOuter(const Grid& grid, const Layout& l,
               const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& field, Velocity& v) {
  for (int c = 0; c < 3; ++c) {
    for (int d = 0; d < 3; ++d) {
      forOuter(l, c, d, [&](std::ptrdiff_t outer, std::ptrdiff_t, const int* q) {
        v.c[c][outer] = field(pointOf(grid, c, q[0], q[1], q[2]))[c];
      });
    }
  }
}

void fillWing(const Grid& grid, const Layout& l, const WallVelocity& wall, Velocity& v) {
  if (grid.k_wing < l.k0 - 1 || grid.k_wing > l.k1) return;  // not among the planes stored here
  for (int j = 0; j < l.ny; ++j) {
    for (int i = 0; i < l.nx; ++i) {
      if (grid.isWing(i, j))
        v.c[2][l.at(i, j, grid.k_wing)] = wall.at(2, grid.x.centre[i], grid.y.centre[j]);
    }
  }
}

double relativeDivergence(const Grid& grid, const Layout& l, const Velocity& v) {
  return relativeDivergence(grid, l, Slab(l.nz), v);
}

double relativeDivergence(const Grid& grid, const Layout& l, const Slab& slab, const Velocity& v) {
  double speed = 0, worst = 0;
  for (int c = 0; c < 3; ++c) {
    for (double q : v.c[c]) speed = std::max(speed, std::abs(q));
  }
  speed = slab.max(speed);
  if (speed == 0) return 0;
  for (int k = l.k0; k < l.k1; ++k) {
    for (int j = 0; j < l.ny; ++j) {
      for (int i = 0; i < l.nx; ++i) {
        const std::ptrdiff_t q = l.at(i, j, k);
        const double hx = grid.x.width[i], hy = grid.y.width[j], hz = grid.z.width[k];
        const double net = (v.c[0][q + 1] - v.c[0][q]) * hy * hz +
                           (v.c[1][q + l.sy] - v.c[1][q]) * hx * hz +
                           (v.c[2][q + l.sz] - v.c[2][q]) * hx * hy;
        worst = std::max(worst, std::abs(net) / std::max({hy * hz, hx * hz, hx * hy}));
      }
    }
  }
  return slab.max(worst) / speed;
}

}  // namespace monarch_flight::fluid
