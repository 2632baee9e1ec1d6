// Setting up, right side and the order of things; coefficients in momentum_coefficients.cpp, the
// factors are solved in momentum_plane.cpp (x, y) and momentum_normal.cpp (z).
#include "fluid/momentum.h"

#include <algorithm>
#include <cmath>

#include "fluid/interleave.h"
#include "fluid/momentum_stencil.h"

namespace monarch_flight {
namespace {

constexpr double kDissipation = 1.0 / 32;  ///< fourth difference, at Courant numbers of 1 and above

/// Off-diagonals of the three factors along one row.
struct Offs {
  const double *lx, *ux, *ly, *uy, *lz, *uz;
};

/// d -= sum of off * (neighbour - v), for i0 <= i <= i1.
void subtractFluxes(const Offs& o, const double* __restrict v, std::ptrdiff_t sy, std::ptrdiff_t sz,
                    int i0, int i1, double* __restrict d) {
  const double* __restrict lx = o.lx;
  const double* __restrict ux = o.ux;
  const double* __restrict ly = o.ly;
  const double* __restrict uy = o.uy;
  const double* __restrict lz = o.lz;
  const double* __restrict uz = o.uz;
  const double* __restrict south = v - sy;
  const double* __restrict north = v + sy;
  const double* __restrict down = v - sz;
  const double* __restrict up = v + sz;
  for (int i = i0; i <= i1; ++i) {
    d[i] -= lx[i] * (v[i - 1] - v[i]) + ux[i] * (v[i + 1] - v[i]) + ly[i] * (south[i] - v[i]) +
            uy[i] * (north[i] - v[i]) + lz[i] * (down[i] - v[i]) + uz[i] * (up[i] - v[i]);
  }
}

/// d -= min(scale |f(i) + f(i + o)|, share) * fourth difference of v with stride s, scale(i) = x[i]
/// * scale_row.
void subtractFourth(const double* __restrict v, std::ptrdiff_t s, const double* __restrict f,
                    const double* __restrict f_before, const double* __restrict x, double scale_row,
                    double share, int i0, int i1, double* __restrict d) {
  const double* __restrict b1 = v - s;
  const double* __restrict b2 = v - 2 * s;
  const double* __restrict a1 = v + s;
  const double* __restrict a2 = v + 2 * s;
  for (int i = i0; i <= i1; ++i) {
    const double factor = scale_row * x[i] * std::abs(f[i] + f_before[i]);
    d[i] -= std::min(share, factor) * (a2[i] + b2[i] - 4 * (a1[i] + b1[i]) + 6 * v[i]);
  }
}

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
  const std::size_t lines = std::max({layout.nx, layout.ny, layout.nz}) + 8;
  for (Array* row : {&lower_, &upper_, &wall_diagonal_, &wall_side_, &zero_, &x_above_, &x_below_,
                     &x_central_[0], &x_central_[1], &y_central_[0], &y_central_[1]})
    row->assign(layout.sy, 0.0);
  for (YFaces* faces : {&y_central_faces_, &y_factor_faces_}) {
    faces->above.assign(2 * layout.sy, 0.0);
    faces->below.assign(2 * layout.sy, 0.0);
  }
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

void Momentum::prepare(const MomentumStep& step, const Velocity& vn, const Velocity& vm,
                       const Velocity& c, const Array& p, const WallVelocity& wall_n) {
  step_ = step;
  for (int component = 0; component < 3; ++component) {
    for (int k = first(component, 2); k <= last(component, 2); ++k) {
      const bool swept = !(component == 2 && k == grid_.k_wing);
      solvePlane(component, k, swept, [&](int j, Row x, Row y) {
        rightSide(vn, vm, c, p, wall_n, component, j, k);
        coefficientsX<FactorFace>(c, component, j, k, x);
        coefficientsY<FactorFace>(c, component, j, k, y);
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
      coefficientsX<FactorFace>(c, 2, j, kw, x);
      coefficientsY<FactorFace>(c, 2, j, kw, y);
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
  const double* __restrict w = v_star.c[2].data() + layout_.at(0, j, kw);
  std::fill(out, out + layout_.nx, 0.0);
  for (int direction = 0; direction < 3; ++direction) {
    double* lo = lower_.data();
    double* up = upper_.data();
    double iw = 1;
    if (direction == 0) {
      coefficientsX<CentralFace>(c, 2, j, kw, {lo, up});
    } else {
      iw = metric_[2][direction].inverse_width[direction == 1 ? j : kw];
      rowFaces<CentralFace>(c, 2, direction, j, kw, lo, up);
      for (int i = 0; i < layout_.nx; ++i) lo[i] = -lo[i];
      rowFaces<CentralFace>(c, 2, direction, j + (direction == 1), kw + (direction == 2),
                            next_.data(), up);
    }
    const std::ptrdiff_t s = layout_.stride(direction);
    for (int i = 0; i < layout_.nx; ++i) {
      if (grid_.isWing(i, j))
        out[i] += iw * (lo[i] * (w[i - s] - w[i]) + up[i] * (w[i + s] - w[i]));
    }
  }
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

/// (v^n - v^(n-1)) / 3 - a (A v^n + grad p / rho) less the fourth differences, of one row.
void Momentum::rightSide(const Velocity& vn, const Velocity& vm, const Velocity& c, const Array& p,
                         const WallVelocity& wall_n, int component, int j, int k) {
  const std::ptrdiff_t row = layout_.at(0, j, k), sc = layout_.stride(component);
  const int i0 = first(component, 0), i1 = last(component, 0), kw = grid_.k_wing;
  const double* __restrict v = vn.c[component].data() + row;
  const double* __restrict w = vm.c[component].data() + row;
  const double* __restrict q = p.data() + row;
  const double* __restrict q_before = q - sc;
  double* __restrict d = delta_.c[component].data() + row;
  const double third = step_.second_order ? 1.0 / 3 : 0.0, scale = step_.a / step_.rho;
  const double* __restrict iw = metric_[component][component].inverse_width.data();
  if (component == 0) {
    for (int i = i0; i <= i1; ++i)
      d[i] = third * (v[i] - w[i]) - scale * iw[i] * (q[i] - q_before[i]);
  } else {
    const double gradient = scale * iw[component == 1 ? j : k];
    for (int i = i0; i <= i1; ++i) d[i] = third * (v[i] - w[i]) - gradient * (q[i] - q_before[i]);
  }

  double* behind = z_behind_.data() + j * layout_.sy;
  const Row x{x_central_[0].data(), x_central_[1].data()};
  const Row y{y_central_[0].data(), y_central_[1].data()};
  coefficientsX<CentralFace>(c, component, j, k, x);
  coefficientsY<CentralFace>(c, component, j, k, y);
  if (k == first(component, 2)) faceBehindZ<CentralFace>(c, component, j, k, +1, behind);
  coefficientsZ<CentralFace>(c, component, j, k, +1, behind, {lower_.data(), upper_.data()});
  if (component != 2 && (k == kw || k == kw - 1)) {
    cutAtWing(component, j, k, k == kw ? lower_.data() : upper_.data(), wall_diagonal_.data());
    const double y_point = position(component, 1, j);
    for (int i = i0; i <= i1; ++i)
      d[i] += wall_diagonal_[i] * (wall_n.at(component, position(component, 0, i), y_point) - v[i]);
  }
  subtractFluxes({x.lower, x.upper, y.lower, y.upper, lower_.data(), upper_.data()}, v, layout_.sy,
                 layout_.sz, i0, i1, d);

  const double share = step_.a / step_.dt * kDissipation, courant = 0.5 * step_.dt * share;
  const double* cx = c.c[0].data() + row;
  const double* cy = c.c[1].data() + row;
  subtractFourth(v, 1, cx, component == 0 ? cx : cx - sc, fourth_x_[component].data(), courant,
                 share, i0, i1, d);
  if (j >= 2 + first(component, 1) && j <= layout_.ny - 3) {
    subtractFourth(v, layout_.sy, cy, component == 1 ? cy : cy - sc, one_.data(),
                   courant * metric_[component][1].inverse_width[j], share, i0, i1, d);
  }
  if (const double* m = grid_.mobility.row(component, j, k)) {
    for (int i = i0; i <= i1; ++i) d[i] += (m[i] - 1) * (d[i] - third * (v[i] - w[i]));
  }
}

}  // namespace monarch_flight
