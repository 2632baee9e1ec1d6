// The right side of the momentum step, row by row.
#include <algorithm>
#include <cmath>

#include "fluid/momentum.h"

namespace monarch_flight {
namespace {

constexpr double kDissipation = 1.0 / 32;  ///< fourth difference, at Courant numbers of 1 and above

/// One direction of a A, seen from the points of a row: faces below and above each of them.
struct Transport {
  const double *lower_a, *lower_b;  ///< convecting velocities on both sides of the lower face
  const double *upper_a, *upper_b;
  const double *before, *after;  ///< neighbours of v
  double half_a, diffusion;      ///< a / 2, a nu, over the width of the control volume along y or z
  double lower, upper;           ///< 1 / distance to the neighbours along y or z

  double at(int i, const double* __restrict v, double width, double lower_distance,
            double upper_distance) const {
    const double mean_lower = 0.5 * (lower_a[i] + lower_b[i]);
    const double mean_upper = 0.5 * (upper_a[i] + upper_b[i]);
    return width * ((half_a * mean_upper - diffusion * upper_distance) * (after[i] - v[i]) -
                    (half_a * mean_lower + diffusion * lower_distance) * (before[i] - v[i]));
  }
};

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

void Momentum::subtractTransport(const Velocity& c, int component, int j, int k,
                                 const double* __restrict v, double* __restrict d) const {
  const int index[3] = {0, j, k};
  Transport along[3];
  for (int direction = 0; direction < 3; ++direction) {
    const std::ptrdiff_t s = layout_.stride(direction);
    const std::ptrdiff_t o = component == direction ? s : layout_.stride(component);
    const double* f = c.c[direction].data() + layout_.at(0, j, k);
    const Direction& m = metric_[component][direction];
    const int n = index[direction];
    const double width = direction == 0 ? 1 : m.inverse_width[n];
    along[direction] = {f,
                        f - o,
                        f + s,
                        f + s - o,
                        v - s,
                        v + s,
                        0.5 * step_.a * width,
                        step_.a * step_.nu * width,
                        m.inverse_distance[n],
                        m.inverse_distance[n + 1]};
  }
  const Transport &x = along[0], &y = along[1], &z = along[2];
  const double* __restrict iw = metric_[component][0].inverse_width.data();
  const double* __restrict distance = metric_[component][0].inverse_distance.data();
  for (int i = first(component, 0), end = last(component, 0); i <= end; ++i) {
    d[i] -= x.at(i, v, iw[i], distance[i], distance[i + 1]) + y.at(i, v, 1, y.lower, y.upper) +
            z.at(i, v, 1, z.lower, z.upper);
  }
}

/// Beside the wing: friction with the wall at half a cell in place of that with the air beyond it.
void Momentum::addWallShear(const WallVelocity& wall, int component, int j, int k,
                            const double* __restrict v, double* __restrict d) {
  const bool above = k == grid_.k_wing;
  const double* beyond = above ? v - layout_.sz : v + layout_.sz;
  const int i0 = first(component, 0), i1 = last(component, 0);
  double* link = lower_.data();
  std::fill(link + i0, link + i1 + 1, 0.0);
  cutAtWing(component, j, k, link, wall_diagonal_.data());
  const double y = position(component, 1, j);
  for (int i = i0; i <= i1; ++i) {
    d[i] += wall_diagonal_[i] * (wall.at(component, position(component, 0, i), y) - v[i]) -
            link[i] * (beyond[i] - v[i]);
  }
}

void Momentum::subtractFourthDifferences(const Velocity& c, int component, int j, int k,
                                         const double* v, double* d) const {
  const std::ptrdiff_t row = layout_.at(0, j, k), sc = layout_.stride(component);
  const int i0 = first(component, 0), i1 = last(component, 0);
  const double share = step_.a / step_.dt * kDissipation, courant = 0.5 * step_.dt * share;
  const double* cx = c.c[0].data() + row;
  const double* cy = c.c[1].data() + row;
  subtractFourth(v, 1, cx, component == 0 ? cx : cx - sc, fourth_x_[component].data(), courant,
                 share, i0, i1, d);
  if (j < 2 + first(component, 1) || j > layout_.ny - 3) return;
  subtractFourth(v, layout_.sy, cy, component == 1 ? cy : cy - sc, one_.data(),
                 courant * metric_[component][1].inverse_width[j], share, i0, i1, d);
}

/// (v^n - v^(n-1)) / 3 - a (A v^n + grad p / rho) less the fourth differences, of one row.
void Momentum::rightSide(const Velocity& vn, const Velocity& vm, const Velocity& c, const Array& p,
                         const WallVelocity& wall_n, int component, int j, int k) {
  const std::ptrdiff_t row = layout_.at(0, j, k);
  const int i0 = first(component, 0), i1 = last(component, 0), kw = grid_.k_wing;
  const double* __restrict v = vn.c[component].data() + row;
  const double* __restrict w = vm.c[component].data() + row;
  const double* __restrict q = p.data() + row;
  const double* __restrict q_before = q - layout_.stride(component);
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
  subtractTransport(c, component, j, k, v, d);
  if (component != 2 && (k == kw || k == kw - 1)) addWallShear(wall_n, component, j, k, v, d);
  subtractFourthDifferences(c, component, j, k, v, d);
  if (const double* m = grid_.mobility.row(component, j, k)) {
    for (int i = i0; i <= i1; ++i) d[i] += (m[i] - 1) * (d[i] - third * (v[i] - w[i]));
  }
}

}  // namespace monarch_flight
