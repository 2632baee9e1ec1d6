#include "fluid/momentum.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace monarch_flight {
namespace {

/// Share of first-order upwind in the factors at small Courant numbers. It acts on the increment
/// alone, so it costs no order; the explicit side has none there.
constexpr double kUpwindMin = 0.05;
constexpr double kUpwindMax = 0.30;        ///< on both sides, at Courant numbers above 2
constexpr double kDissipation = 1.0 / 32;  ///< fourth difference, at Courant numbers of 1 and above
constexpr int kLines = 8;                  ///< lines solved together in the x sweep (one vector)

double upwind(double courant, double least) {
  return std::min(kUpwindMax, std::max(least, kUpwindMin + 0.25 * (courant - 1.0)));
}

/// a A_d: `minus` and `plus` are the convecting velocities on the lower and upper side of the
/// point.
struct Stencil {
  double a, dt, nu, least;
  double lower(double minus, double inv_dist, double inv_width) const {
    const double m = std::abs(minus);
    return -a * (0.5 * (minus + upwind(m * dt * inv_dist, least) * m) + nu * inv_dist) * inv_width;
  }
  double upper(double plus, double inv_dist, double inv_width) const {
    const double m = std::abs(plus);
    return a * (0.5 * (plus - upwind(m * dt * inv_dist, least) * m) - nu * inv_dist) * inv_width;
  }
};

}  // namespace

Momentum::Momentum(const Grid& grid, const Layout& layout, const Slab& slab)
    : grid_(grid), layout_(layout), slab_(slab), delta_(layout) {
  const Axis* axes[3] = {&grid.x, &grid.y, &grid.z};
  for (int c = 0; c < 3; ++c) {
    for (int d = 0; d < 3; ++d) {
      const Axis& axis = *axes[d];
      const int n = axis.n(), start = c == d ? 1 : 0;
      Direction& m = metric_[c][d];
      m.inverse_width.assign(n + 2, 0.0);
      m.inverse_distance.assign(n + 2, 0.0);
      for (int i = start; i < n; ++i)
        m.inverse_width[i] = 1 / (c == d ? axis.gap[i] : axis.width[i]);
      for (int i = start; i <= n; ++i)
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
  upper_ = wall_diagonal_ = wall_side_ = zero_ = lower_;
  gamma_.assign(line * std::max<std::size_t>(layout.sy, kLines), 0.0);
  if (slab.ranks() > 1) gamma_field_.assign(layout.size(), 0.0);
}

double Momentum::position(int component, int direction, int index) const {
  const Axis& axis = direction == 0 ? grid_.x : grid_.y;
  return component == direction ? axis.face[index] : axis.centre[index];
}

void Momentum::coefficients(const Velocity& c, int component, int direction, int j, int k, Row row,
                            double least_upwind) const {
  const Direction& m = metric_[component][direction];
  const std::ptrdiff_t s = layout_.stride(direction);
  const std::ptrdiff_t o = component == direction ? -s : -layout_.stride(component);
  const double* __restrict f = c.c[direction].data() + layout_.at(0, j, k);
  double* __restrict lower = row.lower;
  double* __restrict upper = row.upper;
  const Stencil stencil{step_.a, step_.dt, step_.nu, least_upwind};
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
        const double* plane = delta_.c[2].data() + layout_.plane(k);
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
  if (slab_.owns(grid_.k_wing)) {
    std::copy(wing_plane_.begin(), wing_plane_.end(),
              delta_.c[2].data() + layout_.plane(grid_.k_wing));
    sweepX(c, 2, grid_.k_wing, &wall_change);
    sweepY(c, 2, grid_.k_wing, &wall_change);
  }
  for (int component = 0; component < 3; ++component) {
    sweepZ(c, wall_change, component, v_star);
    for (int k = first(component, 2); k <= last(component, 2); ++k) {
      for (int j = first(component, 1); j <= last(component, 1); ++j) {
        const double* __restrict v = vn.c[component].data() + layout_.at(0, j, k);
        double* __restrict d = v_star.c[component].data() + layout_.at(0, j, k);
        for (int i = first(component, 0); i <= last(component, 0); ++i) d[i] += v[i];
      }
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
    coefficients(c, component, direction, j, k, {lo, up}, 0.0);
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

void Momentum::normalTransport(const Velocity& c, const Velocity& v_star, int j, double* out) {
  const double* __restrict w = v_star.c[2].data() + layout_.at(0, j, grid_.k_wing);
  std::fill(out, out + layout_.nx, 0.0);
  for (int direction = 0; direction < 3; ++direction) {
    const double* lo = lower_.data();
    const double* up = upper_.data();
    coefficients(c, 2, direction, j, grid_.k_wing, {lower_.data(), upper_.data()}, 0.0);
    const std::ptrdiff_t s = layout_.stride(direction);
    for (int i = 0; i < layout_.nx; ++i) {
      if (grid_.isWing(i, j)) out[i] += lo[i] * (w[i - s] - w[i]) + up[i] * (w[i + s] - w[i]);
    }
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
      coefficients(c, component, 0, jb + l, k, row, kUpwindMin);
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
    coefficients(c, component, 1, j, k, {lo, up}, kUpwindMin);
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

struct Momentum::Lines {
  int component;
  const double* side;  // right sides (layout of the fields)
  double* x;           // solution in place of the reduced right sides (layout of the fields)
  double* gamma;       // off-diagonal left after elimination, of the point (0, j, 0)
  std::ptrdiff_t gamma_plane;  // stride of k in gamma
  std::ptrdiff_t gamma_row;    // stride of j in gamma
  double* gammaAt(int j, int k) const { return gamma + j * gamma_row + k * gamma_plane; }
};

void Momentum::eliminateRow(const Velocity& c, const WallVelocity& wall_change, const Lines& lines,
                            int j, int k, int towards) {
  const int component = lines.component, i0 = first(component, 0), i1 = last(component, 0);
  const int kw = grid_.k_wing;
  double* lower = lower_.data();
  double* upper = upper_.data();
  coefficients(c, component, 2, j, k, {lower, upper}, kUpwindMin);
  const bool is_end = towards > 0 ? k == (component == 2) : k == layout_.nz - 1;
  const std::ptrdiff_t row = layout_.at(0, j, k);
  const double* __restrict near = towards > 0 ? lower : upper;
  const double* __restrict far = towards > 0 ? upper : lower;
  const double* __restrict r = lines.side + row;
  double* __restrict d = lines.x + row;
  double* __restrict g = lines.gammaAt(j, k);
  const double* __restrict dp = is_end ? zero_.data() : lines.x + row - towards * layout_.sz;
  const double* __restrict gp = is_end ? zero_.data() : lines.gammaAt(j, k - towards);
  if (component != 2 &&
      (k == kw || k == kw - 1)) {  // sees the wall at half a cell where it is wing
    const Direction& m = metric_[component][2];
    const double wall = 2 * step_.a * step_.nu / (grid_.z.width[k] * grid_.z.width[k]);
    const double link = step_.a * step_.nu * m.inverse_distance[kw] * m.inverse_width[k];
    const double y = position(component, 1, j);
    double* __restrict cut = k == kw ? lower : upper;
    for (int i = i0; i <= i1; ++i) {
      const double b = blocked(component, i, j);
      cut[i] += b * link;
      wall_diagonal_[i] = b * wall;
      wall_side_[i] = b * wall * wall_change.at(component, position(component, 0, i), y);
    }
    for (int i = i0; i <= i1; ++i) {
      const double inv = 1 / (1 - near[i] - far[i] + wall_diagonal_[i] - near[i] * gp[i]);
      g[i] = far[i] * inv;
      d[i] = (r[i] + wall_side_[i] - near[i] * dp[i]) * inv;
    }
    return;
  }
  for (int i = i0; i <= i1; ++i) {
    const double inv = 1 / (1 - near[i] - far[i] - near[i] * gp[i]);
    g[i] = far[i] * inv;
    d[i] = (r[i] - near[i] * dp[i]) * inv;
  }
  if (component == 2 && k == kw) {
    for (int i = i0; i <= i1; ++i) {
      if (!grid_.isWing(i, j)) continue;
      g[i] = 0;
      d[i] = wall_change.at(2, grid_.x.centre[i], grid_.y.centre[j]);
    }
  }
}

/// Half 0: the planes below the wing's, upwards; half 1: those above, downwards.
void Momentum::eliminate(const Velocity& c, const WallVelocity& wall_change, const Lines& lines,
                         int j, int half) {
  const int k0 = first(lines.component, 2), k1 = last(lines.component, 2), kw = grid_.k_wing;
  if (half == 0) {
    for (int k = k0; k <= std::min(k1, kw - 1); ++k) eliminateRow(c, wall_change, lines, j, k, +1);
  } else {
    for (int k = k1; k >= std::max(k0, kw); --k) eliminateRow(c, wall_change, lines, j, k, -1);
  }
}

/// The two points that meet at the wing's plane, of which this process owns one or both.
void Momentum::join(const Lines& lines, int j) const {
  const int i0 = first(lines.component, 0), i1 = last(lines.component, 0), kw = grid_.k_wing;
  const double* __restrict ga = lines.gammaAt(j, kw - 1);
  const double* __restrict gb = lines.gammaAt(j, kw);
  double* __restrict a = lines.x + layout_.at(0, j, kw - 1);
  double* __restrict b = lines.x + layout_.at(0, j, kw);
  for (int i = i0; i <= i1; ++i) {
    const double inv = 1 / (1 - ga[i] * gb[i]), below = a[i], above = b[i];
    a[i] = (below - ga[i] * above) * inv;
    b[i] = (above - gb[i] * below) * inv;
  }
}

void Momentum::substitute(const Lines& lines, int j, int half) const {
  const int i0 = first(lines.component, 0), i1 = last(lines.component, 0), kw = grid_.k_wing;
  const int k0 = first(lines.component, 2), k1 = last(lines.component, 2);
  const int begin = half == 0 ? std::min(k1, kw - 2) : std::max(k0, kw + 1);
  const int count = half == 0 ? begin - k0 + 1 : k1 - begin + 1, towards = half == 0 ? -1 : +1;
  for (int n = 0; n < count; ++n) {
    const int k = begin + n * towards;
    double* __restrict x = lines.x + layout_.at(0, j, k);
    const double* __restrict solved = x - towards * layout_.sz;
    const double* __restrict g = lines.gammaAt(j, k);
    for (int i = i0; i <= i1; ++i) x[i] -= g[i] * solved[i];
  }
}

void Momentum::sweepZ(const Velocity& c, const WallVelocity& wall_change, int component,
                      Velocity& v_star) {
  const int j0 = first(component, 1), j1 = last(component, 1), kw = grid_.k_wing;
  Lines lines{
      component, delta_.c[component].data(), v_star.c[component].data(), gamma_.data(), layout_.sy,
      0};
  if (slab_.ranks() == 1) {
    for (int j = j0; j <= j1; ++j) {
      eliminate(c, wall_change, lines, j, 0);
      eliminate(c, wall_change, lines, j, 1);
      join(lines, j);
      substitute(lines, j, 0);
      substitute(lines, j, 1);
    }
    return;
  }
  // The same with the lines cut by slabs: planes pass from process to process towards the wing and
  // back.
  lines.gamma = gamma_field_.data() + layout_.at(0, 0, 0);
  lines.gamma_plane = layout_.sz;
  lines.gamma_row = layout_.sy;
  const int k0 = layout_.k0, k1 = layout_.k1, n = static_cast<int>(layout_.sz);
  const bool has_below = k0<kw, has_above = k1> kw;
  auto x = [&](int k) { return lines.x + layout_.plane(k); };
  auto gamma = [&](int k) { return gamma_field_.data() + layout_.plane(k); };
  if (has_below) {
    if (!slab_.atBottom()) {
      slab_.receiveFromBelow(x(k0 - 1), n);
      slab_.receiveFromBelow(gamma(k0 - 1), n);
    }
    for (int j = j0; j <= j1; ++j) eliminate(c, wall_change, lines, j, 0);
    if (k1 < kw) {
      slab_.sendUp(x(k1 - 1), n);
      slab_.sendUp(gamma(k1 - 1), n);
    }
  }
  if (has_above) {
    if (!slab_.atTop()) {
      slab_.receiveFromAbove(x(k1), n);
      slab_.receiveFromAbove(gamma(k1), n);
    }
    for (int j = j0; j <= j1; ++j) eliminate(c, wall_change, lines, j, 1);
    if (k0 > kw) {
      slab_.sendDown(x(k0), n);
      slab_.sendDown(gamma(k0), n);
    }
  }
  if (k1 == kw) {
    slab_.exchangeAbove(x(kw - 1), x(kw), n);
    slab_.exchangeAbove(gamma(kw - 1), gamma(kw), n);
  } else if (k0 == kw) {
    slab_.exchangeBelow(x(kw), x(kw - 1), n);
    slab_.exchangeBelow(gamma(kw), gamma(kw - 1), n);
  }
  if (k0 <= kw && k1 >= kw) {
    for (int j = j0; j <= j1; ++j) join(lines, j);
  }
  if (has_below) {
    if (k1 < kw) slab_.receiveFromAbove(x(k1), n);
    for (int j = j0; j <= j1; ++j) substitute(lines, j, 0);
    if (!slab_.atBottom()) slab_.sendDown(x(k0), n);
  }
  if (has_above) {
    if (k0 > kw) slab_.receiveFromBelow(x(k0 - 1), n);
    for (int j = j0; j <= j1; ++j) substitute(lines, j, 1);
    if (!slab_.atTop()) slab_.sendUp(x(k1 - 1), n);
  }
}

}  // namespace monarch_flight
