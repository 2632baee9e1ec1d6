// The x and y factors, plane by plane.
#include "fluid/momentum/plane.h"

#include <algorithm>

namespace monarch_flight::fluid::momentum {
namespace {

/// Thomas' algorithm along x for kLines neighbouring rows, one in each lane; off-diagonals are
/// formed from the velocities through the faces on the way. All arrays are interleaved.
template <bool kMobile>
void eliminateX(const FaceStencil& stencil, const Metrics::Direction& axis, int i0, int i1,
                const double* sum, const double* mobility, const double* extra,
                double* __restrict gamma, double* __restrict side) {
  constexpr int kPacks = kLines / kPack;
  const double* inv_dist = axis.inverse_distance.data();
  const double* inv_width = axis.inverse_width.data();
  Pack above[kPacks], gamma_before[kPacks] = {}, side_before[kPacks] = {};
  for (int p = 0; p < kPacks; ++p) {
    Pack below;
    stencil(load(sum + i0 * kLines + p * kPack), inv_dist[i0], above[p], below);
  }
  for (int i = i0; i <= i1; ++i) {
    for (int p = 0; p < kPacks; ++p) {
      const int q = i * kLines + p * kPack;
      Pack above_next, below_next;
      stencil(load(sum + q + kLines), inv_dist[i + 1], above_next, below_next);
      Pack lower = -inv_width[i] * above[p], upper = inv_width[i] * below_next;
      if (kMobile) {
        const Pack m = load(mobility + q), friction = stencil.diffusion * inv_width[i] * m;
        lower = m * lower - friction * load(extra + q);
        upper = m * upper - friction * load(extra + q + kLines);
      }
      const Pack inv = 1 / (1 - lower - upper - lower * gamma_before[p]);
      gamma_before[p] = upper * inv;
      side_before[p] = (load(side + q) - lower * side_before[p]) * inv;
      store(gamma_before[p], gamma + q);
      store(side_before[p], side + q);
      above[p] = above_next;
    }
  }
  for (int i = i1 - 1; i >= i0; --i) {
    for (int p = 0; p < kPacks; ++p) {
      const int q = i * kLines + p * kPack;
      side_before[p] = load(side + q) - load(gamma + q) * side_before[p];
      store(side_before[p], side + q);
    }
  }
}

/// One row of the elimination along y.
void eliminateY(int i0, int i1, const double* __restrict lower, const double* __restrict upper,
                const double* __restrict gamma_before, const double* __restrict side_before,
                double* __restrict gamma, double* __restrict side) {
#pragma omp simd
  for (int i = i0; i <= i1; ++i) {
    const double inv = 1 / (1 - lower[i] - upper[i] - lower[i] * gamma_before[i]);
    gamma[i] = upper[i] * inv;
    side[i] = (side[i] - lower[i] * side_before[i]) * inv;
  }
}

/// The first row: nothing before it.
void eliminateFirstY(int i0, int i1, const double* __restrict lower, const double* __restrict upper,
                     double* __restrict gamma, double* __restrict side) {
#pragma omp simd
  for (int i = i0; i <= i1; ++i) {
    const double inv = 1 / (1 - lower[i] - upper[i]);
    gamma[i] = upper[i] * inv;
    side[i] *= inv;
  }
}

void substituteRow(int i0, int i1, const double* __restrict gamma, const double* __restrict solved,
                   double* __restrict side) {
#pragma omp simd
  for (int i = i0; i <= i1; ++i) side[i] -= gamma[i] * solved[i];
}

/// Both factors of `lines` rows from row j on, whose faces and off-diagonals stand in the scratch.
void solveRows(const Metrics& m, const FaceStencil& stencil, int component, int j, int k, int lines,
               double* rows, PlaneScratch& s) {
  const Layout& l = m.layout;
  const int i0 = m.first(component, 0), i1 = m.last(component, 0);
  const bool mobile = m.grid.mobility.row(component, j, k) != nullptr;
  interleave(s.x_sum.data() + 8, l.sy, lines, i1 + 2, s.lane_sum.data());
  interleave(rows, l.sy, lines, i1 + 1, s.lane_side.data());
  if (mobile) {
    for (int n = 0; n < lines; ++n) {
      const double* row = m.grid.mobility.row(component, j + n, k);
      std::copy(row, row + l.nx, s.x_mobility.data() + n * l.sy + 8);
    }
    interleave(s.x_mobility.data() + 8, l.sy, lines, i1 + 1, s.lane_mobility.data());
    interleave(m.rim.extra(component, 0, m.rim.side(component, k), j), l.sy, lines, i1 + 2,
               s.lane_extra.data());
  }
  (mobile ? eliminateX<true> : eliminateX<false>)(stencil, m.axis[component][0], i0, i1,
                                                  s.lane_sum.data(), s.lane_mobility.data(),
                                                  s.lane_extra.data(), s.lane_gamma.data(),
                                                  s.lane_side.data());
  separate(s.lane_side.data(), lines, i1 + 1, rows, l.sy);
  for (int n = 0; n < lines; ++n) {
    double* lower = s.y_lower.data() + n * l.sy + 8;
    double* upper = s.y_upper.data() + n * l.sy + 8;
    if (mobile) {
      const double* row = m.grid.mobility.row(component, j + n, k);
      for (int i = i0; i <= i1; ++i) lower[i] *= row[i], upper[i] *= row[i];
    }
    double* side = rows + n * l.sy;
    double* gamma = s.gamma_y.data() + (j + n) * l.sy + 8;
    if (j + n == m.first(component, 1)) {
      eliminateFirstY(i0, i1, lower, upper, gamma, side);
    } else {
      eliminateY(i0, i1, lower, upper, gamma - l.sy, side - l.sy, gamma, side);
    }
  }
}

void substituteY(const Metrics& m, int component, double* plane, const PlaneScratch& s) {
  const std::ptrdiff_t sy = m.layout.sy;
  for (int j = m.last(component, 1) - 1; j >= m.first(component, 1); --j) {
    double* row = plane + j * sy;
    substituteRow(m.first(component, 0), m.last(component, 0), s.gamma_y.data() + j * sy + 8,
                  row + sy, row);
  }
}

/// Rows of `lines` in ascending order, kLines of them at a time: fill(row, scratch's line).
template <class Fill, class Solve>
void byBlocks(const Metrics& m, int component, Fill fill, Solve solve) {
  const int end = m.last(component, 1) + 1;
  for (int j = m.first(component, 1); j < end; j += kLines) {
    const int lines = std::min(kLines, end - j);
    for (int n = 0; n < lines; ++n) fill(j + n, n);
    solve(j, lines);
  }
}

/// Where row j, the n-th of a block, puts its factors.
RowFactors factorsOf(const Layout& l, int j, int n, PlaneScratch& s) {
  const std::ptrdiff_t at = n * l.sy + 8;
  const int here = j % 2, next = 1 - here;
  return {s.x_sum.data() + at,       s.y_lower.data() + at,      s.y_upper.data() + at,
          s.y_sum[here].data() + 8,  s.y_above[here].data() + 8, s.y_sum[next].data() + 8,
          s.y_above[next].data() + 8};
}

void firstFaces(const Metrics& m, const MomentumStep& step, const Velocity& c, int component, int k,
                PlaneScratch& s) {
  const int j = m.first(component, 1), here = j % 2;
  firstFacesY(m, step, c, component, j, k, s.y_sum[here].data() + 8, s.y_above[here].data() + 8);
}

}  // namespace

PlaneScratch::PlaneScratch(const Layout& layout) {
  for (Array* block : {&x_sum, &x_mobility, &y_lower, &y_upper, &lane_sum, &lane_mobility,
                       &lane_extra, &lane_gamma, &lane_side})
    block->assign(kLines * layout.sy, 0.0);
  for (Array* row : {&y_sum[0], &y_sum[1], &y_above[0], &y_above[1]}) row->assign(layout.sy, 0.0);
  gamma_y.assign(layout.sz, 0.0);
}

void solvePlane(const Metrics& m, const MomentumStep& step, const ExplicitSide& side, int component,
                int k, double* delta, PlaneScratch& s) {
  const FaceStencil stencil(step);
  double* plane = delta + m.layout.at(0, 0, k);
  firstFaces(m, step, side.c, component, k, s);
  byBlocks(
      m, component,
      [&](int j, int n) {
        formRow(m, step, side, component, j, k, plane + j * m.layout.sy,
                factorsOf(m.layout, j, n, s));
      },
      [&](int j, int lines) {
        solveRows(m, stencil, component, j, k, lines, plane + j * m.layout.sy, s);
      });
  substituteY(m, component, plane, s);
}

void formWingPlane(const Metrics& m, const MomentumStep& step, const ExplicitSide& side,
                   double* delta, PlaneScratch& s) {
  const int kw = m.grid.k_wing;
  firstFaces(m, step, side.c, 2, kw, s);
  for (int j = 0; j < m.layout.ny; ++j)
    formRow(m, step, side, 2, j, kw, delta + m.layout.at(0, j, kw), factorsOf(m.layout, j, 0, s));
}

void solveWingPlane(const Metrics& m, const MomentumStep& step, const Velocity& c,
                    const WallVelocity& wall_change, double* delta, PlaneScratch& s) {
  const int kw = m.grid.k_wing;
  const FaceStencil stencil(step);
  double* plane = delta + m.layout.at(0, 0, kw);
  firstFaces(m, step, c, 2, kw, s);
  byBlocks(
      m, 2,
      [&](int j, int n) {
        formFactors(m, step, c, 2, j, kw, factorsOf(m.layout, j, n, s));
        double* row = plane + j * m.layout.sy;
        for (int i = 0; i < m.layout.nx; ++i) {  // mobility 0: such a face is linked to nothing
          if (m.grid.isWing(i, j))
            row[i] = wall_change.at(2, m.grid.x.centre[i], m.grid.y.centre[j]);
        }
      },
      [&](int j, int lines) {
        solveRows(m, stencil, 2, j, kw, lines, plane + j * m.layout.sy, s);
      });
  substituteY(m, 2, plane, s);
}

}  // namespace monarch_flight::fluid::momentum
