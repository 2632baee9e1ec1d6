// The z factor, which sees the wall's new velocity, on one process or several.
#include <algorithm>
#include <array>

#include "fluid/momentum/momentum.h"

namespace monarch_flight::fluid::momentum {

struct Momentum::Lines {
  int component;
  const double* side;  // right sides (layout of the fields)
  double* x;           // solution in place of the reduced right sides (layout of the fields)
  double* gamma;       // off-diagonal left after elimination, of the point (0, j, 0)
  std::ptrdiff_t gamma_plane;  // stride of k in gamma
  std::ptrdiff_t gamma_row;    // stride of j in gamma
  double* gammaAt(int j, int k) const { return gamma + j * gamma_row + k * gamma_plane; }

  // Lines that are cut by slabs: planes pass from process to process towards the wing and back.
  void eliminateSlabs(Momentum& m, const Velocity& c, const WallVelocity& wall_change,
                      RowRange rows) const;
  void joinSlabs(const Momentum& m, RowRange rows) const;
  void substituteSlabs(const Momentum& m, RowRange rows) const;
  /// Plane k of solution and factors.
  std::array<double*, 2> plane(const Momentum& m, int k) const {
    return {x + m.layout_.plane(k), gamma - m.layout_.at(0, 0, 0) + m.layout_.plane(k)};
  }
};

void Momentum::eliminateRow(const Velocity& c, const WallVelocity& wall_change, const Lines& lines,
                            int j, int k, int towards) {
  const int component = lines.component, i0 = first(component, 0), i1 = last(component, 0);
  const int kw = grid_.k_wing;
  double* lower = lower_.data();
  double* upper = upper_.data();
  coefficientsZ(c, component, j, k, towards, &z_behind_[j * layout_.sy], {lower, upper});
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
    const double y = position(component, 1, j);
    cutAtWing(component, j, k, k == kw ? lower : upper, wall_diagonal_.data());
    mobilise(component, j, k, {lower, upper, wall_diagonal_.data()});
    for (int i = i0; i <= i1; ++i) {
      wall_side_[i] = wall_diagonal_[i] * wall_change.at(component, position(component, 0, i), y);
    }
    for (int i = i0; i <= i1; ++i) {
      const double inv = 1 / (1 - near[i] - far[i] + wall_diagonal_[i] - near[i] * gp[i]);
      g[i] = far[i] * inv;
      d[i] = (r[i] + wall_side_[i] - near[i] * dp[i]) * inv;
    }
    return;
  }
  mobilise(component, j, k, {lower, upper});
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
                         RowRange rows, int half) {
  const int k0 = first(lines.component, 2), k1 = last(lines.component, 2), kw = grid_.k_wing;
  const int begin = half == 0 ? k0 : k1, end = half == 0 ? std::min(k1, kw - 1) : std::max(k0, kw);
  const int towards = half == 0 ? +1 : -1, planes = (end - begin) * towards + 1;
  if (planes <= 0) return;
  for (int j = rows.first; j <= rows.last; ++j)
    faceBehindZ(c, lines.component, j, begin, towards, &z_behind_[j * layout_.sy]);
  for (int n = 0; n < planes; ++n) {
    for (int j = rows.first; j <= rows.last; ++j)
      eliminateRow(c, wall_change, lines, j, begin + n * towards, towards);
  }
}

/// The two points that meet at the wing's plane, of which this process owns one or both. With one
/// cell below it the lower point of w is the outer face, which does not change: its line has only
/// the half above.
void Momentum::join(const Lines& lines, RowRange rows) const {
  if (lines.component == 2 && grid_.k_wing == 1) return;
  const int i0 = first(lines.component, 0), i1 = last(lines.component, 0), kw = grid_.k_wing;
  for (int j = rows.first; j <= rows.last; ++j) {
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
}

void Momentum::substitute(const Lines& lines, RowRange rows, int half) const {
  const int i0 = first(lines.component, 0), i1 = last(lines.component, 0), kw = grid_.k_wing;
  const int k0 = first(lines.component, 2), k1 = last(lines.component, 2);
  const int begin = half == 0 ? std::min(k1, kw - 2) : std::max(k0, kw + 1);
  const int count = half == 0 ? begin - k0 + 1 : k1 - begin + 1, towards = half == 0 ? -1 : +1;
  for (int n = 0; n < count; ++n) {
    const int k = begin + n * towards;
    for (int j = rows.first; j <= rows.last; ++j) {
      double* __restrict x = lines.x + layout_.at(0, j, k);
      const double* __restrict solved = x - towards * layout_.sz;
      const double* __restrict g = lines.gammaAt(j, k);
      for (int i = i0; i <= i1; ++i) x[i] -= g[i] * solved[i];
    }
  }
}

void Momentum::addLevel(const Lines& lines, const Velocity& vn, RowRange rows) const {
  const int i0 = first(lines.component, 0), i1 = last(lines.component, 0);
  for (int k = first(lines.component, 2); k <= last(lines.component, 2); ++k) {
    for (int j = rows.first; j <= rows.last; ++j) {
      const double* __restrict v = vn.c[lines.component].data() + layout_.at(0, j, k);
      double* __restrict x = lines.x + layout_.at(0, j, k);
      for (int i = i0; i <= i1; ++i) x[i] += v[i];
    }
  }
}

void Momentum::Lines::eliminateSlabs(Momentum& m, const Velocity& c,
                                     const WallVelocity& wall_change, RowRange rows) const {
  const int k0 = m.layout_.k0, k1 = m.layout_.k1, kw = m.grid_.k_wing;
  const int n = static_cast<int>(m.layout_.sz);
  if (k0 < kw) {
    if (!m.slab_.atBottom()) {
      for (double* p : plane(m, k0 - 1)) m.slab_.receiveFromBelow(p, n);
    }
    m.eliminate(c, wall_change, *this, rows, 0);
    if (k1 < kw) {
      for (double* p : plane(m, k1 - 1)) m.slab_.sendUp(p, n);
    }
  }
  if (k1 > kw) {
    if (!m.slab_.atTop()) {
      for (double* p : plane(m, k1)) m.slab_.receiveFromAbove(p, n);
    }
    m.eliminate(c, wall_change, *this, rows, 1);
    if (k0 > kw) {
      for (double* p : plane(m, k0)) m.slab_.sendDown(p, n);
    }
  }
}

/// Two processes that meet at the wing's plane first exchange their points beside it.
void Momentum::Lines::joinSlabs(const Momentum& m, RowRange rows) const {
  const int k0 = m.layout_.k0, k1 = m.layout_.k1, kw = m.grid_.k_wing;
  const int n = static_cast<int>(m.layout_.sz);
  if (k0 > kw || k1 < kw) return;
  const std::array<double*, 2> below = plane(m, kw - 1), above = plane(m, kw);
  for (std::size_t i = 0; i < 2; ++i) {
    if (k1 == kw) m.slab_.exchangeAbove(below[i], above[i], n);
    if (k0 == kw) m.slab_.exchangeBelow(above[i], below[i], n);
  }
  m.join(*this, rows);
}

void Momentum::Lines::substituteSlabs(const Momentum& m, RowRange rows) const {
  const int k0 = m.layout_.k0, k1 = m.layout_.k1, kw = m.grid_.k_wing;
  const int n = static_cast<int>(m.layout_.sz);
  if (k0 < kw) {
    if (k1 < kw) m.slab_.receiveFromAbove(plane(m, k1)[0], n);
    m.substitute(*this, rows, 0);
    if (!m.slab_.atBottom()) m.slab_.sendDown(plane(m, k0)[0], n);
  }
  if (k1 > kw) {
    if (k0 > kw) m.slab_.receiveFromBelow(plane(m, k0 - 1)[0], n);
    m.substitute(*this, rows, 1);
    if (!m.slab_.atTop()) m.slab_.sendUp(plane(m, k1 - 1)[0], n);
  }
}

void Momentum::sweepZ(const Velocity& c, const WallVelocity& wall_change, int component,
                      const Velocity& vn, Velocity& v_star) {
  const int j0 = first(component, 1), j1 = last(component, 1);
  Lines lines{component,     delta_.c[component].data(), v_star.c[component].data(),
              gamma_.data(), kRowsZ * layout_.sy,        layout_.sy};
  if (slab_.ranks() > 1) {
    lines.gamma = gamma_field_.data() + layout_.at(0, 0, 0);
    lines.gamma_plane = layout_.sz;
    lines.eliminateSlabs(*this, c, wall_change, {j0, j1});
    lines.joinSlabs(*this, {j0, j1});
    lines.substituteSlabs(*this, {j0, j1});
    addLevel(lines, vn, {j0, j1});
    return;
  }
  for (int j = j0; j <= j1; j += kRowsZ) {
    const RowRange rows{j, std::min(j + kRowsZ - 1, j1)};
    lines.gamma = gamma_.data() - j * layout_.sy;
    eliminate(c, wall_change, lines, rows, 0);
    eliminate(c, wall_change, lines, rows, 1);
    join(lines, rows);
    substitute(lines, rows, 0);
    substitute(lines, rows, 1);
    addLevel(lines, vn, rows);
  }
}

}  // namespace monarch_flight::fluid::momentum
