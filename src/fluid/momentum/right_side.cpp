// The right side of the momentum step, row by row.
#include <algorithm>
#include <cmath>

#include "fluid/momentum/momentum.h"

namespace monarch_flight::fluid::momentum {
namespace {

constexpr double kDissipation = 1.0 / 32;  ///< fourth difference, at Courant numbers of 1 and above

/// Convecting velocities around the points of a row: those of their lower faces are the means of
/// `lower` and `lower_before`, those of the upper faces of `upper` and `upper_before`.
struct FaceVelocities {
  const double *lower, *lower_before, *upper, *upper_before;
};

/// d -= a A_x v.
void subtractAlongRow(const FaceVelocities& f, double half_a, double diffusion,
                      const double* __restrict width, const double* __restrict distance,
                      const double* __restrict v, int i0, int i1, double* __restrict d) {
  const double* __restrict l = f.lower;
  const double* __restrict lb = f.lower_before;
  const double* __restrict u = f.upper;
  const double* __restrict ub = f.upper_before;
  for (int i = i0; i <= i1; ++i) {
    const double below = 0.5 * half_a * (l[i] + lb[i]) + diffusion * distance[i];
    const double above = 0.5 * half_a * (u[i] + ub[i]) - diffusion * distance[i + 1];
    d[i] -= width[i] * (above * (v[i + 1] - v[i]) - below * (v[i - 1] - v[i]));
  }
}

/// d -= a A v along y or z, `s` the stride there; inverse distances to the neighbours.
void subtractAcrossRows(const FaceVelocities& f, double half_a, double diffusion,
                        double distance_below, double distance_above, std::ptrdiff_t s,
                        const double* __restrict v, int i0, int i1, double* __restrict d) {
  const double* __restrict l = f.lower;
  const double* __restrict lb = f.lower_before;
  const double* __restrict u = f.upper;
  const double* __restrict ub = f.upper_before;
  const double* __restrict before = v - s;
  const double* __restrict after = v + s;
  const double friction_below = diffusion * distance_below;
  const double friction_above = diffusion * distance_above, quarter = 0.5 * half_a;
  for (int i = i0; i <= i1; ++i) {
    const double below = quarter * (l[i] + lb[i]) + friction_below;
    const double above = quarter * (u[i] + ub[i]) - friction_above;
    d[i] -= above * (after[i] - v[i]) - below * (before[i] - v[i]);
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

void Momentum::subtractTransport(const Velocity& c, int component, int j, int k, const double* v,
                                 double* d) const {
  const int i0 = first(component, 0), i1 = last(component, 0), index[3] = {0, j, k};
  const double half_a = 0.5 * step_.a, diffusion = step_.a * step_.nu;
  for (int direction = 0; direction < 3; ++direction) {
    const std::ptrdiff_t s = layout_.stride(direction);
    const std::ptrdiff_t o = component == direction ? s : layout_.stride(component);
    const double* f = c.c[direction].data() + layout_.at(0, j, k);
    const FaceVelocities velocities{f, f - o, f + s, f + s - o};
    const Direction& m = metric_[component][direction];
    const double* distance = m.inverse_distance.data() + index[direction];
    if (direction == 0) {
      subtractAlongRow(velocities, half_a, diffusion, m.inverse_width.data(), distance, v, i0, i1,
                       d);
    } else {
      const double width = m.inverse_width[index[direction]];
      subtractAcrossRows(velocities, half_a * width, diffusion * width, distance[0], distance[1], s,
                         v, i0, i1, d);
    }
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

}  // namespace monarch_flight::fluid::momentum
