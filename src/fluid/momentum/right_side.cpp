// The right side of the momentum step, row by row.
#include "fluid/momentum/right_side.h"

#include <algorithm>
#include <cmath>

#include "fluid/momentum/wall.h"

namespace monarch_flight::fluid::momentum {
namespace {

constexpr double kDissipation = 1.0 / 32;  ///< fourth difference, at Courant numbers of 1 and above

/// Pointers at the point (0, j, k) of a row, and the row's constants.
struct Row {
  int i0, i1;
  std::ptrdiff_t sc, sy, sz;   ///< strides: of the component's own direction, of y, of z
  const double *v, *w;         ///< levels n and n-1
  const double *q, *q_before;  ///< pressure on both sides of the point
  const double *cx, *cy, *cz;  ///< convecting field
  const double *width, *distance, *fourth;  ///< along x, inverse
  double width_y, y_below, y_above;         ///< inverse: width, distances
  double width_z, z_below, z_above;
  double memory, gradient;  ///< weight of v^n - v^(n-1); a / rho (times 1 / width but along x)
  double share, courant_x, courant_y;  ///< of the fourth differences
};

Row rowOf(const Metrics& m, const MomentumStep& step, const ExplicitSide& side, int component,
          int j, int k) {
  const std::ptrdiff_t at = m.layout.at(0, j, k);
  const Metrics::Direction* axis = m.axis[component];
  Row r;
  r.i0 = m.first(component, 0), r.i1 = m.last(component, 0);
  r.sc = m.layout.stride(component), r.sy = m.layout.sy, r.sz = m.layout.sz;
  r.v = side.vn.c[component].data() + at, r.w = side.vm.c[component].data() + at;
  r.q = side.p.data() + at, r.q_before = r.q - r.sc;
  r.cx = side.c.c[0].data() + at, r.cy = side.c.c[1].data() + at, r.cz = side.c.c[2].data() + at;
  r.width = axis[0].inverse_width.data(), r.distance = axis[0].inverse_distance.data();
  r.fourth = m.fourth_x[component].data();
  r.width_y = axis[1].inverse_width[j], r.width_z = axis[2].inverse_width[k];
  r.y_below = axis[1].inverse_distance[j], r.y_above = axis[1].inverse_distance[j + 1];
  r.z_below = axis[2].inverse_distance[k], r.z_above = axis[2].inverse_distance[k + 1];
  r.memory = step.memory;
  r.gradient = step.a / step.rho * (component == 0 ? 1 : component == 1 ? r.width_y : r.width_z);
  r.share = step.a / step.dt * kDissipation;
  r.courant_x = 0.5 * step.dt * r.share;
  const bool reached = j >= 2 + m.first(component, 1) && j <= m.layout.ny - 3;
  r.courant_y = reached ? r.courant_x * r.width_y : 0.0;
  return r;
}

/// Everything but what is special beside the wing. C: the component.
template <int C>
void form(const Row& r, const FaceStencil& stencil, double* d, const RowFactors& out) {
  const std::ptrdiff_t sc = C == 0 ? 1 : r.sc, sy = r.sy, sz = r.sz;
  const double *v = r.v, *w = r.w, *q = r.q, *q_before = r.q_before;
  const double *cx = r.cx, *cy = r.cy + sy, *cz = r.cz;
  const double *width = r.width, *distance = r.distance, *fourth = r.fourth;
  const double *y_sum = out.y_sum, *y_above = out.y_above;
  double *x_sum = out.x_sum, *y_lower = out.y_lower, *y_upper = out.y_upper;
  double *y_sum_next = out.y_sum_next, *y_above_next = out.y_above_next;
  const double quarter = stencil.quarter_a, nu = stencil.diffusion;
  const double quarter_y = quarter * r.width_y, quarter_z = quarter * r.width_z;
  const double nu_y0 = nu * r.width_y * r.y_below, nu_y1 = nu * r.width_y * r.y_above;
  const double nu_z0 = nu * r.width_z * r.z_below, nu_z1 = nu * r.width_z * r.z_above;
  const double distance_y = r.y_above, width_y = r.width_y;
  const double memory = r.memory, gradient = r.gradient, share = r.share;
  const double courant_x = r.courant_x, courant_y = r.courant_y;
#pragma omp simd
  for (int i = r.i0; i <= r.i1; ++i) {
    const double here = v[i];
    const double x0 = cx[i] + cx[i - sc], x1 = cx[i + 1] + cx[i + 1 - sc];
    const double y0 = y_sum[i], y1 = cy[i] + cy[i - sc];
    const double z0 = cz[i] + cz[i - sc], z1 = cz[i + sz] + cz[i + sz - sc];
    const double slope = C == 0 ? gradient * width[i] : gradient;
    double sum = memory * (here - w[i]) - slope * (q[i] - q_before[i]);
    sum -= width[i] * ((quarter * x1 - nu * distance[i + 1]) * (v[i + 1] - here) -
                       (quarter * x0 + nu * distance[i]) * (v[i - 1] - here));
    sum -= (quarter_y * y1 - nu_y1) * (v[i + sy] - here) -
           (quarter_y * y0 + nu_y0) * (v[i - sy] - here);
    sum -= (quarter_z * z1 - nu_z1) * (v[i + sz] - here) -
           (quarter_z * z0 + nu_z0) * (v[i - sz] - here);
    const double limit_x = courant_x * fourth[i] * std::abs(C == 0 ? 2 * cx[i] : x0);
    sum -= std::min(share, limit_x) * (v[i + 2] + v[i - 2] - 4 * (v[i + 1] + v[i - 1]) + 6 * here);
    const double limit_y = courant_y * std::abs(C == 1 ? 2 * cy[i - sy] : y0);
    sum -= std::min(share, limit_y) *
           (v[i + 2 * sy] + v[i - 2 * sy] - 4 * (v[i + sy] + v[i - sy]) + 6 * here);
    d[i] = sum;
    x_sum[i] = x0;
    double above, below;
    stencil(y1, distance_y, above, below);
    y_lower[i] = -width_y * y_above[i];
    y_upper[i] = width_y * below;
    y_sum_next[i] = y1;
    y_above_next[i] = above;
  }
  x_sum[r.i1 + 1] = cx[r.i1 + 1] + cx[r.i1 + 1 - sc];
}

void form(int component, const Row& r, const FaceStencil& stencil, double* d,
          const RowFactors& out) {
  component == 0   ? form<0>(r, stencil, d, out)
  : component == 1 ? form<1>(r, stencil, d, out)
                   : form<2>(r, stencil, d, out);
}

/// Beside the wing: friction with the wall at half a cell in place of that with the air beyond it.
void addWallShear(const Metrics& m, const WallLinks& links, const WallVelocity& wall, int component,
                  int j, bool above, const double* v, double* d) {
  const double* beyond = above ? v - m.layout.sz : v + m.layout.sz;
  const double* seen = m.rim.wall(component, above, j);
  const double* cut = m.rim.cut(component, above, j);
  const double y = m.y(component, j);
  for (int i = m.first(component, 0), end = m.last(component, 0); i <= end; ++i) {
    if (cut[i] == 0) continue;
    d[i] += seen[i] * links.wall * (wall.at(component, m.x(component, i), y) - v[i]) -
            cut[i] * links.beyond * (beyond[i] - v[i]);
  }
}

/// Beside the rim: what the friction within the plane is more than by differences.
void addRimFriction(const Metrics& m, const MomentumStep& step, int component, int j, int k,
                    const double* v, double* d) {
  const int side = m.rim.side(component, k);
  const std::ptrdiff_t sy = m.layout.sy;
  const Metrics::Direction* axis = m.axis[component];
  const double friction = step.a * step.nu, friction_y = friction * axis[1].inverse_width[j];
  const double* x = m.rim.extra(component, 0, side, j);
  const double* y0 = m.rim.extra(component, 1, side, j);
  const double* y1 = m.rim.extra(component, 1, side, j + 1);
  const double* width = axis[0].inverse_width.data();
  const int i0 = m.first(component, 0), i1 = m.last(component, 0);
#pragma omp simd
  for (int i = i0; i <= i1; ++i) {
    d[i] += friction * width[i] * (x[i + 1] * (v[i + 1] - v[i]) + x[i] * (v[i - 1] - v[i])) +
            friction_y * (y1[i] * (v[i + sy] - v[i]) + y0[i] * (v[i - sy] - v[i]));
  }
}

/// The same in the off-diagonals along y.
void addRimFactors(const Metrics& m, const MomentumStep& step, int component, int j, int k,
                   const RowFactors& out) {
  const int side = m.rim.side(component, k);
  const double friction_y = step.a * step.nu * m.axis[component][1].inverse_width[j];
  const double* y0 = m.rim.extra(component, 1, side, j);
  const double* y1 = m.rim.extra(component, 1, side, j + 1);
  for (int i = m.first(component, 0); i <= m.last(component, 0); ++i) {
    out.y_lower[i] -= friction_y * y0[i];
    out.y_upper[i] -= friction_y * y1[i];
  }
}

}  // namespace

void firstFacesY(const Metrics& m, const MomentumStep& step, const Velocity& c, int component,
                 int j, int k, double* sum, double* above) {
  const double* f = c.c[1].data() + m.layout.at(0, j, k);
  const std::ptrdiff_t sc = m.layout.stride(component);
  const double inv_dist = m.axis[component][1].inverse_distance[j];
  const FaceStencil stencil(step);
  double below;
  for (int i = m.first(component, 0), end = m.last(component, 0); i <= end; ++i) {
    sum[i] = f[i] + f[i - sc];
    stencil(sum[i], inv_dist, above[i], below);
  }
}

void formFactors(const Metrics& m, const MomentumStep& step, const Velocity& c, int component,
                 int j, int k, const RowFactors& out) {
  const std::ptrdiff_t at = m.layout.at(0, j, k), sc = m.layout.stride(component);
  const double* cx = c.c[0].data() + at;
  const double* cy = c.c[1].data() + at + m.layout.sy;
  const double inv_width = m.axis[component][1].inverse_width[j];
  const double inv_dist = m.axis[component][1].inverse_distance[j + 1];
  const FaceStencil stencil(step);
  for (int i = m.first(component, 0), end = m.last(component, 0); i <= end; ++i) {
    double below;
    out.x_sum[i] = cx[i] + cx[i - sc];
    out.x_sum[i + 1] = cx[i + 1] + cx[i + 1 - sc];
    out.y_sum_next[i] = cy[i] + cy[i - sc];
    out.y_lower[i] = -inv_width * out.y_above[i];
    stencil(out.y_sum_next[i], inv_dist, out.y_above_next[i], below);
    out.y_upper[i] = inv_width * below;
  }
  if (m.rim.reaches(component, k)) addRimFactors(m, step, component, j, k, out);
}

void formRow(const Metrics& m, const MomentumStep& step, const ExplicitSide& side, int component,
             int j, int k, double* d, const RowFactors& out) {
  const Row r = rowOf(m, step, side, component, j, k);
  form(component, r, FaceStencil(step), d, out);
  const int kw = m.grid.k_wing;
  if (component != 2 && (k == kw || k == kw - 1)) {
    addWallShear(m, wallLinks(m, step, component, k), side.wall_n, component, j, k == kw, r.v, d);
  }
  if (m.rim.reaches(component, k)) {
    addRimFriction(m, step, component, j, k, r.v, d);
    addRimFactors(m, step, component, j, k, out);
  }
  if (const double* mobility = m.grid.mobility.row(component, j, k)) {
    for (int i = r.i0; i <= r.i1; ++i)
      d[i] += (mobility[i] - 1) * (d[i] - r.memory * (r.v[i] - r.w[i]));
  }
}

void normalTransport(const Metrics& m, const MomentumStep& step, const Velocity& c,
                     const Velocity& v, int j, double* out) {
  const int index[3] = {0, j, m.grid.k_wing};
  const std::ptrdiff_t at = m.layout.at(0, j, m.grid.k_wing), sz = m.layout.sz;
  const FaceStencil stencil(step);
  for (int i = 0; i < m.layout.nx; ++i) {
    out[i] = 0;
    for (int d = 0; d < 3 && m.grid.isWing(i, j); ++d) {
      const Metrics::Direction& axis = m.axis[2][d];
      const int q = d == 0 ? i : index[d];
      const std::ptrdiff_t s = m.layout.stride(d);
      const double* f = c.c[d].data() + at + i;
      const double* u = v.c[2].data() + at + i;
      const double more0 = d == 2 ? 0 : stencil.diffusion * m.rim.extra(2, d, 0, j)[i];
      const double more1 =
          d == 2 ? 0 : stencil.diffusion * m.rim.extra(2, d, 0, j + (d == 1))[i + (d == 0)];
      const double below = stencil.quarter_a * (f[0] + f[-sz]) +
                           stencil.diffusion * axis.inverse_distance[q] + more0;
      const double above = stencil.quarter_a * (f[s] + f[s - sz]) -
                           stencil.diffusion * axis.inverse_distance[q + 1] - more1;
      out[i] += axis.inverse_width[q] * (above * (u[s] - u[0]) - below * (u[-s] - u[0]));
    }
  }
}

}  // namespace monarch_flight::fluid::momentum
