#include "fluid/momentum.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace monarch_flight {
namespace {

constexpr double kUpwindMin = 0.05;        ///< share of first-order upwind at small Courant numbers
constexpr double kUpwindMax = 0.30;        ///< and at Courant numbers above 2
constexpr double kDissipation = 1.0 / 32;  ///< fourth difference, at Courant numbers of 1 and above
constexpr int kLines = 8;                  ///< lines solved together in the x sweep (one vector)

double upwind(double courant) {
  return std::min(kUpwindMax, std::max(kUpwindMin, kUpwindMin + 0.25 * (courant - 1.0)));
}

/// a A_d: `minus` and `plus` are the convecting velocities on the lower and upper side of the
/// point.
struct Stencil {
  double a, dt, nu;
  double lower(double minus, double inv_dist, double inv_width) const {
    const double m = std::abs(minus);
    return -a * (0.5 * (minus + upwind(m * dt * inv_dist) * m) + nu * inv_dist) * inv_width;
  }
  double upper(double plus, double inv_dist, double inv_width) const {
    const double m = std::abs(plus);
    return a * (0.5 * (plus - upwind(m * dt * inv_dist) * m) - nu * inv_dist) * inv_width;
  }
};

}  // namespace

Momentum::Momentum(const Grid& grid, const Layout& layout)
    : grid_(grid), layout_(layout), delta_(layout) {
  const Axis* axes[3] = {&grid.x, &grid.y, &grid.z};
  for (int c = 0; c < 3; ++c) {
    for (int d = 0; d < 3; ++d) {
      const Axis& axis = *axes[d];
      const int n = axis.n();
      Direction& m = metric_[c][d];
      m.inverse_width.assign(n + 2, 0.0);
      m.inverse_distance.assign(n + 2, 0.0);
      for (int i = first(c, d); i < n; ++i)
        m.inverse_width[i] = 1 / (c == d ? axis.gap[i] : axis.width[i]);
      for (int i = first(c, d); i <= n; ++i)
        m.inverse_distance[i] = 1 / (c == d ? axis.width[i - 1] : axis.gap[i]);
    }
    blocked_[c].assign(layout.sz, 0.0);
  }
  auto wing = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < layout.nx && j < layout.ny && grid.isWing(i, j) ? 1.0 : 0.0;
  };
  for (int j = 0; j <= layout.ny; ++j) {
    for (int i = 0; i <= layout.nx; ++i) {
      const std::size_t q = static_cast<std::size_t>((j + 1) * layout.sy + i + 8);
      blocked_[0][q] = 0.5 * (wing(i - 1, j) + wing(i, j));
      blocked_[1][q] = 0.5 * (wing(i, j - 1) + wing(i, j));
      blocked_[2][q] = wing(i, j);
    }
  }
  wing_plane_.assign(layout.sz, 0.0);
  const std::size_t line = std::max({layout.nx, layout.ny, layout.nz}) + 8;
  lower_.assign(std::max<std::size_t>(layout.sy, kLines * line), 0.0);
  upper_ = zlower_ = zupper_ = lower_;
  gamma_.assign(line * std::max<std::size_t>(layout.sy, kLines), 0.0);
}

double Momentum::position(int component, int direction, int index) const {
  const Axis& axis = direction == 0 ? grid_.x : grid_.y;
  return component == direction ? axis.face[index] : axis.centre[index];
}

void Momentum::coefficients(const Velocity& c, int component, int direction, int j, int k,
                            Row row) const {
  const Direction& m = metric_[component][direction];
  const std::ptrdiff_t s = layout_.stride(direction);
  const std::ptrdiff_t o = component == direction ? -s : -layout_.stride(component);
  const double* __restrict f = c.c[direction].data() + layout_.at(0, j, k);
  double* __restrict lower = row.lower;
  double* __restrict upper = row.upper;
  const Stencil stencil{step_.a, step_.dt, step_.nu};
  const int i0 = first(component, 0), i1 = last(component, 0);
  if (direction == 0) {
    const double* __restrict iw = m.inverse_width.data();
    const double* __restrict id = m.inverse_distance.data();
    for (int i = i0; i <= i1; ++i) {
      lower[i] = stencil.lower(0.5 * (f[i] + f[i + o]), id[i], iw[i]);
      upper[i] = stencil.upper(0.5 * (f[i + s] + f[i + s + o]), id[i + 1], iw[i]);
    }
    return;
  }
  const int n = direction == 1 ? j : k;
  const double iw = m.inverse_width[n], id0 = m.inverse_distance[n],
               id1 = m.inverse_distance[n + 1];
  for (int i = i0; i <= i1; ++i) {
    lower[i] = stencil.lower(0.5 * (f[i] + f[i + o]), id0, iw);
    upper[i] = stencil.upper(0.5 * (f[i + s] + f[i + s + o]), id1, iw);
  }
}

void Momentum::prepare(const MomentumStep& step, const Velocity& vn, const Velocity& vm,
                       const Velocity& c, const Array& p, const WallVelocity& wall_n) {
  step_ = step;
  for (int component = 0; component < 3; ++component) {
    for (int k = first(component, 2); k <= last(component, 2); ++k) {
      for (int j = first(component, 1); j <= last(component, 1); ++j) {
        rightSide(vn, vm, c, p, wall_n, component, j, k);
      }
      if (component == 2 && k == grid_.k_wing) {
        const double* plane = delta_.c[2].data() + layout_.at(-8, -1, k);
        std::copy(plane, plane + layout_.sz, wing_plane_.begin());
        continue;  // swept in finish(): it holds the wing's faces
      }
      sweepX(c, component, k, nullptr);
      sweepY(c, component, k, nullptr);
    }
  }
}

void Momentum::finish(const Velocity& vn, const Velocity& c, const WallVelocity& wall_change,
                      Velocity& v_star) {
  std::copy(wing_plane_.begin(), wing_plane_.end(),
            delta_.c[2].data() + layout_.at(-8, -1, grid_.k_wing));
  sweepX(c, 2, grid_.k_wing, &wall_change);
  sweepY(c, 2, grid_.k_wing, &wall_change);
  for (int component = 0; component < 3; ++component) {
    for (int j = first(component, 1); j <= last(component, 1); ++j) {
      sweepZ(vn, c, wall_change, component, j, v_star);
    }
  }
}

void Momentum::rightSide(const Velocity& vn, const Velocity& vm, const Velocity& c, const Array& p,
                         const WallVelocity& wall_n, int component, int j, int k) {
  const std::ptrdiff_t row = layout_.at(0, j, k);
  const double* __restrict v = vn.c[component].data() + row;
  const double* __restrict w = vm.c[component].data() + row;
  double* __restrict d = delta_.c[component].data() + row;
  const int i0 = first(component, 0), i1 = last(component, 0);

  const double third = step_.second_order ? 1.0 / 3 : 0.0;
  const std::ptrdiff_t sc = layout_.stride(component);
  const double* __restrict q = p.data() + row;
  const double scale = step_.a / step_.rho;
  if (component == 0) {
    const double* iw = metric_[0][0].inverse_width.data();
    for (int i = i0; i <= i1; ++i) d[i] = third * (v[i] - w[i]) - scale * iw[i] * (q[i] - q[i - 1]);
  } else {
    const double iw = scale * metric_[component][component].inverse_width[component == 1 ? j : k];
    for (int i = i0; i <= i1; ++i) d[i] = third * (v[i] - w[i]) - iw * (q[i] - q[i - sc]);
  }
  for (int direction = 0; direction < 3; ++direction) {
    double* __restrict lo = lower_.data();
    double* __restrict up = upper_.data();
    coefficients(c, component, direction, j, k, {lo, up});
    const std::ptrdiff_t s = layout_.stride(direction);
    if (direction == 2 && component != 2 && (k == grid_.k_wing || k == grid_.k_wing - 1)) {
      // Where the wing lies between two points each of them sees the wall at half a cell instead.
      const bool above = k == grid_.k_wing;
      const Direction& m = metric_[component][2];
      const double wall = 2 * step_.a * step_.nu / (grid_.z.width[k] * grid_.z.width[k]);
      const double link =
          step_.a * step_.nu * m.inverse_distance[grid_.k_wing] * m.inverse_width[k];
      double* __restrict off = above ? lo : up;
      const double y = position(component, 1, j);
      for (int i = i0; i <= i1; ++i) {
        const double b = blocked(component, i, j);
        off[i] += b * link;
        d[i] += b * wall * (wall_n.at(component, position(component, 0, i), y) - v[i]);
      }
    }
    for (int i = i0; i <= i1; ++i) d[i] -= lo[i] * (v[i - s] - v[i]) + up[i] * (v[i + s] - v[i]);
  }
  dissipate(vn, c, component, 0, j, k);
  dissipate(vn, c, component, 1, j, k);
}

void Momentum::dissipate(const Velocity& vn, const Velocity& c, int component, int direction, int j,
                         int k) {
  const int n = direction == 0 ? layout_.nx : layout_.ny;
  if (direction == 1 && (j < 2 + first(component, 1) || j > n - 3)) return;
  const std::ptrdiff_t row = layout_.at(0, j, k), s = layout_.stride(direction);
  const std::ptrdiff_t o = component == direction ? 0 : -layout_.stride(component);
  const double* __restrict v = vn.c[component].data() + row;
  const double* __restrict f = c.c[direction].data() + row;
  double* __restrict d = delta_.c[component].data() + row;
  const double* iw = metric_[component][direction].inverse_width.data();
  const int i0 = direction == 0 ? 2 + first(component, 0) : first(component, 0);
  const int i1 = direction == 0 ? n - 3 : last(component, 0);
  const double share = step_.a / step_.dt * kDissipation;
  for (int i = i0; i <= i1; ++i) {
    const double courant = 0.5 * std::abs(f[i] + f[i + o]) * step_.dt * iw[direction == 0 ? i : j];
    d[i] -= share * std::min(1.0, courant) *
            (v[i + 2 * s] + v[i - 2 * s] - 4 * (v[i + s] + v[i - s]) + 6 * v[i]);
  }
}

void Momentum::fixWingFaces(const WallVelocity& wall_change, int j, double* lower, double* upper,
                            double* d) const {
  for (int i = 0; i < layout_.nx; ++i) {
    if (!grid_.isWing(i, j)) continue;
    lower[i] = upper[i] = 0;
    d[i] = wall_change.at(2, grid_.x.centre[i], grid_.y.centre[j]);
  }
}

void Momentum::sweepX(const Velocity& c, int component, int k, const WallVelocity* wall_change) {
  const int i0 = first(component, 0), i1 = last(component, 0);
  const int j0 = first(component, 1), j1 = last(component, 1);
  const std::ptrdiff_t line = layout_.nx + 8;
  double* __restrict g = gamma_.data();
  for (int jb = j0; jb <= j1; jb += kLines) {
    const int lines = std::min(kLines, j1 - jb + 1);
    double* __restrict d = delta_.c[component].data() + layout_.at(0, jb, k);
    for (int l = 0; l < lines; ++l) {
      Row row{lower_.data() + l * line, upper_.data() + l * line};
      coefficients(c, component, 0, jb + l, k, row);
      if (wall_change) fixWingFaces(*wall_change, jb + l, row.lower, row.upper, d + l * layout_.sy);
    }
    const double* __restrict lo = lower_.data();
    const double* __restrict up = upper_.data();
    for (int l = 0; l < lines; ++l) {
      const double inv = 1 / (1 - lo[l * line + i0] - up[l * line + i0]);
      g[i0 * kLines + l] = up[l * line + i0] * inv;
      d[l * layout_.sy + i0] *= inv;
    }
    for (int i = i0 + 1; i <= i1; ++i) {
      for (int l = 0; l < lines; ++l) {
        const double a = lo[l * line + i], b = up[l * line + i];
        const double inv = 1 / (1 - a - b - a * g[(i - 1) * kLines + l]);
        g[i * kLines + l] = b * inv;
        d[l * layout_.sy + i] = (d[l * layout_.sy + i] - a * d[l * layout_.sy + i - 1]) * inv;
      }
    }
    for (int i = i1 - 1; i >= i0; --i) {
      for (int l = 0; l < lines; ++l)
        d[l * layout_.sy + i] -= g[i * kLines + l] * d[l * layout_.sy + i + 1];
    }
  }
}

void Momentum::sweepY(const Velocity& c, int component, int k, const WallVelocity* wall_change) {
  const int i0 = first(component, 0), i1 = last(component, 0);
  const int j0 = first(component, 1), j1 = last(component, 1);
  double* __restrict lo = lower_.data();
  double* __restrict up = upper_.data();
  for (int j = j0; j <= j1; ++j) {
    double* __restrict d = delta_.c[component].data() + layout_.at(0, j, k);
    coefficients(c, component, 1, j, k, {lo, up});
    if (wall_change) fixWingFaces(*wall_change, j, lo, up, d);
    double* __restrict g = gamma_.data() + j * layout_.sy;
    const double* __restrict gp = gamma_.data() + (j - 1) * layout_.sy;
    const double* __restrict dp = d - layout_.sy;
    if (j == j0) {
      for (int i = i0; i <= i1; ++i) {
        const double inv = 1 / (1 - lo[i] - up[i]);
        g[i] = up[i] * inv;
        d[i] *= inv;
      }
      continue;
    }
    for (int i = i0; i <= i1; ++i) {
      const double inv = 1 / (1 - lo[i] - up[i] - lo[i] * gp[i]);
      g[i] = up[i] * inv;
      d[i] = (d[i] - lo[i] * dp[i]) * inv;
    }
  }
  for (int j = j1 - 1; j >= j0; --j) {
    double* __restrict d = delta_.c[component].data() + layout_.at(0, j, k);
    const double* __restrict g = gamma_.data() + j * layout_.sy;
    const double* __restrict dn = d + layout_.sy;
    for (int i = i0; i <= i1; ++i) d[i] -= g[i] * dn[i];
  }
}

void Momentum::sweepZ(const Velocity& vn, const Velocity& c, const WallVelocity& wall_change,
                      int component, int j, Velocity& v_star) {
  const int i0 = first(component, 0), i1 = last(component, 0);
  const int k0 = first(component, 2), k1 = last(component, 2), kw = grid_.k_wing;
  double* __restrict lo = zlower_.data();
  double* __restrict up = zupper_.data();
  double* __restrict wall_d = lower_.data();  // wall's addition to the diagonal
  double* __restrict wall_r = upper_.data();  // and to the right side
  const double y = position(component, 1, j);
  for (int k = k0; k <= k1; ++k) {
    const std::ptrdiff_t row = layout_.at(0, j, k);
    const double* __restrict r = delta_.c[component].data() + row;
    double* __restrict d = v_star.c[component].data() + row;
    const double* __restrict dp = d - layout_.sz;
    double* __restrict g = gamma_.data() + k * layout_.sy;
    const double* __restrict gp = gamma_.data() + (k > k0 ? k - 1 : k) * layout_.sy;
    coefficients(c, component, 2, j, k, {lo, up});
    const bool at_wall = component == 2 ? k == kw : (k == kw || k == kw - 1);
    if (at_wall && component != 2) {
      const Direction& m = metric_[component][2];
      const double wall = 2 * step_.a * step_.nu / (grid_.z.width[k] * grid_.z.width[k]);
      const double link = step_.a * step_.nu * m.inverse_distance[kw] * m.inverse_width[k];
      double* __restrict off = k == kw ? lo : up;
      for (int i = i0; i <= i1; ++i) {
        const double b = blocked(component, i, j);
        off[i] += b * link;
        wall_d[i] = b * wall;
        wall_r[i] = b * wall * wall_change.at(component, position(component, 0, i), y);
      }
      for (int i = i0; i <= i1; ++i) {
        const double coupling = k == k0 ? 0.0 : lo[i];
        const double inv = 1 / (1 - lo[i] - up[i] + wall_d[i] - coupling * gp[i]);
        g[i] = up[i] * inv;
        d[i] = (r[i] + wall_r[i] - coupling * dp[i]) * inv;
      }
      continue;
    }
    if (k == k0) {
      for (int i = i0; i <= i1; ++i) {
        const double inv = 1 / (1 - lo[i] - up[i]);
        g[i] = up[i] * inv;
        d[i] = r[i] * inv;
      }
      continue;
    }
    for (int i = i0; i <= i1; ++i) {
      const double inv = 1 / (1 - lo[i] - up[i] - lo[i] * gp[i]);
      g[i] = up[i] * inv;
      d[i] = (r[i] - lo[i] * dp[i]) * inv;
    }
    if (at_wall) {
      for (int i = i0; i <= i1; ++i) {
        if (!grid_.isWing(i, j)) continue;
        g[i] = 0;
        d[i] = wall_change.at(2, grid_.x.centre[i], y);
      }
    }
  }
  for (int k = k1; k >= k0; --k) {
    const std::ptrdiff_t row = layout_.at(0, j, k);
    double* __restrict d = v_star.c[component].data() + row;
    const double* __restrict dn = d + layout_.sz;
    const double* __restrict g = gamma_.data() + k * layout_.sy;
    if (k < k1) {
      for (int i = i0; i <= i1; ++i) d[i] -= g[i] * dn[i];
    }
  }
  for (int k = k0; k <= k1; ++k) {
    const std::ptrdiff_t row = layout_.at(0, j, k);
    double* __restrict d = v_star.c[component].data() + row;
    const double* __restrict v = vn.c[component].data() + row;
    for (int i = i0; i <= i1; ++i) d[i] += v[i];
  }
}

}  // namespace monarch_flight
