// The z factor, which sees the wall's new velocity.
#include "fluid/momentum/lines.h"

#include "fluid/momentum/wall.h"

namespace monarch_flight::fluid::momentum {
namespace {

/// A row of a line's elimination: what it reads and leaves, at i = 0.
struct ZRow {
  const double* ahead;  ///< convecting velocity on the faces ahead
  std::ptrdiff_t sc;    ///< to the other velocity of such a face
  double inv_width, inv_dist;
  double* behind;                            ///< stencil of the faces behind, then of those ahead
  const double* side;                        ///< right side
  const double *side_before, *gamma_before;  ///< the row before, reduced
  double *gamma, *reduced;
};

/// Off-diagonals towards the row before (`near`) and after (`far`). T: +1 upwards, -1 downwards.
template <int T>
void offDiagonals(const FaceStencil& stencil, const ZRow& r, int i, double& near, double& far) {
  double above, below;
  stencil(r.ahead[i] + r.ahead[i - r.sc], r.inv_dist, above, below);
  near = (T > 0 ? -r.inv_width : r.inv_width) * r.behind[i];
  far = T > 0 ? r.inv_width * below : -r.inv_width * above;
  r.behind[i] = T > 0 ? above : below;
}

template <int T>
void eliminatePlain(const FaceStencil& stencil, const ZRow& row, int i0, int i1) {
  const ZRow r = row;
#pragma omp simd
  for (int i = i0; i <= i1; ++i) {
    double near, far;
    offDiagonals<T>(stencil, r, i, near, far);
    const double inv = 1 / (1 - near - far - near * r.gamma_before[i]);
    r.gamma[i] = far * inv;
    r.reduced[i] = (r.side[i] - near * r.side_before[i]) * inv;
  }
}

/// The same beside the wing: the share `cut` of the link ahead goes, and `seen` of the wall, whose
/// velocity changes by change(i), is linked to; inertia is 1 / mobility.
template <int T, class Change>
void eliminateBeside(const FaceStencil& stencil, const ZRow& r, int i0, int i1, const double* seen,
                     const double* cut, const double* mobility, const WallLinks& links,
                     Change change) {
  for (int i = i0; i <= i1; ++i) {
    double near, far;
    offDiagonals<T>(stencil, r, i, near, far);
    const double m = mobility ? mobility[i] : 1.0, wall = m * seen[i] * links.wall;
    near *= m;
    far = m * (far + cut[i] * links.beyond);
    const double inv = 1 / (1 - near - far + wall - near * r.gamma_before[i]);
    r.gamma[i] = far * inv;
    r.reduced[i] = (r.side[i] + wall * change(i) - near * r.side_before[i]) * inv;
  }
}

void solveAndAdd(int i0, int i1, const double* gamma, const double* reduced, const double* level,
                 double* solved, double* out) {
#pragma omp simd
  for (int i = i0; i <= i1; ++i) {
    solved[i] = reduced[i] - gamma[i] * solved[i];
    out[i] = level[i] + solved[i];
  }
}

}  // namespace

/// Stencils of the faces behind the first row of a half, on the way upwards or downwards.
void Lines::firstFaces(const LineRange& range, int j, int k, int towards) const {
  const int face = towards > 0 ? k : k + 1;
  const double* f = c.c[2].data() + m.layout.at(0, j, face);
  const std::ptrdiff_t sc = m.layout.stride(component);
  const double inv_dist = m.axis[component][2].inverse_distance[face];
  const FaceStencil stencil(step);
  double* stencils = behindAt(j);
  for (int i = range.i0; i <= range.i1; ++i) {
    double above, below;
    stencil(f[i] + f[i - sc], inv_dist, above, below);
    stencils[i] = towards > 0 ? above : below;
  }
}

void Lines::eliminateRow(const LineRange& range, int j, int k, int towards,
                         const WallVelocity& wall_change) const {
  const Layout& l = m.layout;
  const int kw = m.grid.k_wing, face = towards > 0 ? k + 1 : k;
  const std::ptrdiff_t at = l.at(0, j, k);
  const bool is_end = towards > 0 ? k == (component == 2) : k == l.nz - 1;
  const FaceStencil stencil(step);
  const ZRow row{c.c[2].data() + l.at(0, j, face),
                 l.stride(component),
                 m.axis[component][2].inverse_width[k],
                 m.axis[component][2].inverse_distance[face],
                 behindAt(j),
                 side + at,
                 is_end ? m.zero.data() + 8 : reduced + at - towards * l.sz,
                 is_end ? m.zero.data() + 8 : gammaAt(j, k - towards),
                 gammaAt(j, k),
                 reduced + at};
  const bool beside_wall = component != 2 && (k == kw || k == kw - 1);
  const double* mobility = m.grid.mobility.row(component, j, k);
  if (!beside_wall && !mobility) {
    (towards > 0 ? eliminatePlain<1> : eliminatePlain<-1>)(stencil, row, range.i0, range.i1);
    return;
  }
  const double y = m.y(component, j);
  auto change = [&](int i) { return wall_change.at(component, m.x(component, i), y); };
  const double* none = m.zero.data() + 8;
  const double* seen = beside_wall ? m.rim.wall(component, k - kw + 1, j) : none;
  const double* cut = beside_wall ? m.rim.cut(component, k - kw + 1, j) : none;
  const WallLinks links = beside_wall ? wallLinks(m, step, component, k) : WallLinks{};
  if (towards > 0)
    eliminateBeside<1>(stencil, row, range.i0, range.i1, seen, cut, mobility, links, change);
  else
    eliminateBeside<-1>(stencil, row, range.i0, range.i1, seen, cut, mobility, links, change);
  if (component != 2 || k != kw) return;
  for (int i = range.i0; i <= range.i1; ++i) {  // the wing's own faces
    if (!m.grid.isWing(i, j)) continue;
    row.gamma[i] = 0;
    row.reduced[i] = change(i);
  }
}

void Lines::eliminate(const LineRange& range, int half, int begin, int end,
                      const WallVelocity& wall_change) const {
  const int towards = half == 0 ? +1 : -1, planes = (end - begin) * towards + 1;
  if (planes <= 0) return;
  for (int j = range.first; j <= range.last; ++j) firstFaces(range, j, begin, towards);
  for (int n = 0; n < planes; ++n) {
    for (int j = range.first; j <= range.last; ++j)
      eliminateRow(range, j, begin + n * towards, towards, wall_change);
  }
}

/// With one cell below the wing the lower point of w is the outer face, which does not change: its
/// line has only the half above.
void Lines::join(const LineRange& range) const {
  const int kw = m.grid.k_wing;
  const bool lower = m.layout.k0 < kw && !(component == 2 && kw == 1);
  const bool upper = m.layout.k1 > kw;
  for (int j = range.first; j <= range.last; ++j) {
    const std::ptrdiff_t a = m.layout.at(0, j, kw - 1), b = m.layout.at(0, j, kw);
    const bool both = !(component == 2 && kw == 1);
    const double* gamma_a = both ? gammaAt(j, kw - 1) : m.zero.data() + 8;
    const double* gamma_b = both ? gammaAt(j, kw) : m.zero.data() + 8;
    const double* reduced_a = both ? reduced + a : m.zero.data() + 8;
    const double* reduced_b = reduced + b;
    double *below = solvedAt(0, j), *above = solvedAt(1, j);
    for (int i = range.i0; i <= range.i1; ++i) {
      const double inv = 1 / (1 - gamma_a[i] * gamma_b[i]);
      below[i] = (reduced_a[i] - gamma_a[i] * reduced_b[i]) * inv;
      above[i] = (reduced_b[i] - gamma_b[i] * reduced_a[i]) * inv;
    }
    for (int i = range.i0; lower && i <= range.i1; ++i) out[a + i] = level[a + i] + below[i];
    for (int i = range.i0; upper && i <= range.i1; ++i) out[b + i] = level[b + i] + above[i];
  }
}

void Lines::substitute(const LineRange& range, int half) const {
  const int towards = half == 0 ? -1 : +1, end = outermost(half), kw = m.grid.k_wing;
  const int inner = innermost(half);
  const int begin = inner == kw - 1 + half ? inner + towards : inner;  // `join` has solved that one
  for (int k = begin; (end - k) * towards >= 0; k += towards) {
    for (int j = range.first; j <= range.last; ++j) {
      const std::ptrdiff_t at = m.layout.at(0, j, k);
      solveAndAdd(range.i0, range.i1, gammaAt(j, k), reduced + at, level + at, solvedAt(half, j),
                  out + at);
    }
  }
}

}  // namespace monarch_flight::fluid::momentum
