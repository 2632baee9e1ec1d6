// Setting up, coefficients and the order of things; the right side is in momentum_right_side.cpp,
// the factors are solved in momentum_plane.cpp (x, y) and momentum_normal.cpp (z).
#include "fluid/momentum/momentum.h"

#include <algorithm>
#include <cmath>

#include "fluid/momentum/interleave.h"
#include "fluid/momentum/stencil.h"

namespace monarch_flight::fluid::momentum {
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
  const std::size_t lines = std::max({layout.nx, layout.ny, layout.nz}) + 8;
  for (Array* row : {&lower_, &upper_, &wall_diagonal_, &wall_side_, &zero_, &x_above_, &x_below_})
    row->assign(layout.sy, 0.0);
  for (Array* rows : {&y_above_, &y_below_}) rows->assign(2 * layout.sy, 0.0);
  for (Array* block : {&x_lower_, &x_upper_, &y_lower_, &y_upper_, &lane_lower_, &lane_upper_,
                       &lane_gamma_, &lane_side_})
    block->assign(kLines * layout.sy, 0.0);
  gamma_.assign(kRowsZ * lines * layout.sy, 0.0);
  one_.assign(layout.sy, 1.0);
  z_behind_.assign(layout.sz, 0.0);
  next_.assign(layout.sy, 0.0);
  for (int c = 0; c < 3; ++c) {
    fourth_x_[c].assign(layout.sy, 0.0);
    for (int i = 2 + (c == 0); i <= layout.nx - 3; ++i)
      fourth_x_[c][i] = metric_[c][0].inverse_width[i];
  }
  if (slab.ranks() > 1) gamma_field_.assign(layout.size(), 0.0);
}

double Momentum::position(int component, int direction, int index) const {
  const Axis& axis = direction == 0 ? grid_.x : grid_.y;
  return component == direction ? axis.face[index] : axis.centre[index];
}

/// Stencils of the lower faces, along y or z, of the points of row (j, k).
void Momentum::rowFaces(const Velocity& c, int component, int direction, int j, int k,
                        double* __restrict above, double* __restrict below) const {
  const std::ptrdiff_t o = -layout_.stride(component == direction ? direction : component);
  const double* __restrict f = c.c[direction].data() + layout_.at(0, j, k);
  const double inv_dist = metric_[component][direction].inverse_distance[direction == 1 ? j : k];
  const FaceStencil stencil(step_);
  for (int i = first(component, 0), end = last(component, 0); i <= end; ++i)
    stencil(0.5 * (f[i] + f[i + o]), inv_dist, above[i], below[i]);
}

void Momentum::coefficientsX(const Velocity& c, int component, int j, int k, Row row) {
  const std::ptrdiff_t o = -layout_.stride(component);
  const double* __restrict f = c.c[0].data() + layout_.at(0, j, k);
  const double* __restrict inv_dist = metric_[component][0].inverse_distance.data();
  const double* __restrict iw = metric_[component][0].inverse_width.data();
  double* __restrict above = x_above_.data();
  double* __restrict below = x_below_.data();
  double* __restrict lower = row.lower;
  double* __restrict upper = row.upper;
  const int i0 = first(component, 0), i1 = last(component, 0);
  const FaceStencil stencil(step_);
  for (int i = i0; i <= i1 + 1; ++i)
    stencil(0.5 * (f[i] + f[i + o]), inv_dist[i], above[i], below[i]);
  for (int i = i0; i <= i1; ++i) {
    lower[i] = -iw[i] * above[i];
    upper[i] = iw[i] * below[i + 1];
  }
}

/// Rows of a plane come in ascending order: the upper faces of one are the lower faces of the next.
void Momentum::coefficientsY(const Velocity& c, int component, int j, int k, Row row) {
  const std::ptrdiff_t here = (j % 2) * layout_.sy, next = layout_.sy - here;
  double* above_faces = y_above_.data();
  double* below_faces = y_below_.data();
  if (j == first(component, 1))
    rowFaces(c, component, 1, j, k, above_faces + here, below_faces + here);
  rowFaces(c, component, 1, j + 1, k, above_faces + next, below_faces + next);
  const double* __restrict above = above_faces + here;
  const double* __restrict below = below_faces + next;
  double* __restrict lower = row.lower;
  double* __restrict upper = row.upper;
  const double iw = metric_[component][1].inverse_width[j];
  for (int i = first(component, 0), end = last(component, 0); i <= end; ++i) {
    lower[i] = -iw * above[i];
    upper[i] = iw * below[i];
  }
}

/// The stencil, `above` or `below`, of the face behind row (j, k) on the way upwards or downwards.
void Momentum::faceBehindZ(const Velocity& c, int component, int j, int k, int towards,
                           double* behind) const {
  double* unused = next_.data();
  if (towards > 0) rowFaces(c, component, 2, j, k, behind, unused);
  if (towards < 0) rowFaces(c, component, 2, j, k + 1, unused, behind);
}

/// Rows of a line of z come one after the other: `behind` holds the stencil of the face behind the
/// row (j, k), and then that of the face ahead, for the next row.
void Momentum::coefficientsZ(const Velocity& c, int component, int j, int k, int towards,
                             double* __restrict behind, Row row) const {
  const Direction& m = metric_[component][2];
  const int ahead = towards > 0 ? k + 1 : k;
  double* __restrict off_behind = towards > 0 ? row.lower : row.upper;
  double* __restrict off_ahead = towards > 0 ? row.upper : row.lower;
  double* __restrict next = next_.data();
  const double iw = towards * m.inverse_width[k];
  const int i0 = first(component, 0), i1 = last(component, 0);
  for (int i = i0; i <= i1; ++i) off_behind[i] = -iw * behind[i];
  towards > 0 ? rowFaces(c, component, 2, j, ahead, behind, next)
              : rowFaces(c, component, 2, j, ahead, next, behind);
  for (int i = i0; i <= i1; ++i) off_ahead[i] = iw * next[i];
}

void Momentum::prepare(const MomentumStep& step, const Velocity& vn, const Velocity& vm,
                       const Velocity& c, const Array& p, const WallVelocity& wall_n) {
  step_ = step;
  for (int component = 0; component < 3; ++component) {
    for (int k = first(component, 2); k <= last(component, 2); ++k) {
      const bool swept = !(component == 2 && k == grid_.k_wing);
      solvePlane(component, k, swept, [&](int j, Row x, Row y) {
        rightSide(vn, vm, c, p, wall_n, component, j, k);
        coefficientsX(c, component, j, k, x);
        coefficientsY(c, component, j, k, y);
        mobilise(component, j, k, {x.lower, x.upper, y.lower, y.upper});
      });
      if (swept) continue;
      // Swept in finish(): it holds the wing's faces.
      const double* plane = delta_.c[2].data() + layout_.plane(k);
      std::copy(plane, plane + layout_.sz, wing_plane_.begin());
    }
  }
}

void Momentum::finish(const Velocity& vn, const Velocity& c, const WallVelocity& wall_change,
                      Velocity& v_star) {
  const int kw = grid_.k_wing;
  if (slab_.owns(kw)) {
    double* plane = delta_.c[2].data() + layout_.plane(kw);
    std::copy(wing_plane_.begin(), wing_plane_.end(), plane);
    solvePlane(2, kw, true, [&](int j, Row x, Row y) {
      coefficientsX(c, 2, j, kw, x);
      coefficientsY(c, 2, j, kw, y);
      mobilise(2, j, kw, {x.lower, x.upper, y.lower, y.upper});
      double* d = delta_.c[2].data() + layout_.at(0, j, kw);
      fixWingFaces(wall_change, j, x, d);
      fixWingFaces(wall_change, j, y, d);
    });
  }
  for (int component = 0; component < 3; ++component) sweepZ(c, wall_change, component, vn, v_star);
}

void Momentum::normalTransport(const Velocity& c, const Velocity& v_star, int j, double* out) {
  const int kw = grid_.k_wing;
  std::fill(out, out + layout_.nx, 0.0);
  subtractTransport(c, 2, j, kw, v_star.c[2].data() + layout_.at(0, j, kw), out);
  for (int i = 0; i < layout_.nx; ++i) out[i] = grid_.isWing(i, j) ? -out[i] : 0.0;
}

/// Where the wing lies between two points each of them sees the wall at half a cell instead.
void Momentum::cutAtWing(int component, int j, int k, double* __restrict off,
                         double* __restrict diagonal) const {
  const double width = grid_.z.width[k], wall = 2 * step_.a * step_.nu / (width * width);
  const Direction& m = metric_[component][2];
  const double link = step_.a * step_.nu * m.inverse_distance[grid_.k_wing] * m.inverse_width[k];
  for (int i = first(component, 0), end = last(component, 0); i <= end; ++i) {
    const double b = blocked(component, i, j);
    off[i] += b * link;
    diagonal[i] = b * wall;
  }
}

}  // namespace monarch_flight::fluid::momentum
