// The order of things; the right side is in right_side.cpp, the factors are solved in plane.cpp (x,
// y) and lines.cpp (z).
#include "fluid/momentum/momentum.h"

#include <algorithm>

namespace monarch_flight::fluid::momentum {
namespace {

/// Of the points of a block, those that the wing blocks, from a cache line's first on.
LineRange seenBy(const Metrics& m, int component, LineRange range) {
  int low = range.i1 + 1, high = range.i0 - 1;
  for (int j = range.first; j <= range.last; ++j) {
    const double* wall = m.rim.wall(component, 0, j);
    for (int i = range.i0; i <= range.i1; ++i) {
      if (wall[i] > 0) low = std::min(low, i), high = std::max(high, i);
    }
  }
  range.i0 = std::max(range.i0, low / 8 * 8);
  range.i1 = high;
  return range;
}

}  // namespace

Momentum::Momentum(const Grid& grid, const Layout& layout, const Slab& slab, const Team& team)
    : metrics_(grid, layout),
      layout_(layout),
      slab_(slab),
      team_(team),
      delta_(layout),
      planes_(team.threads(), PlaneScratch(layout)),
      gammas_(team.threads()) {
  for (Array& gamma : gammas_) gamma.assign(kRowsZ * (layout.nz + 1) * layout.sy, 0.0);
  wing_plane_.assign(layout.sz, 0.0);
  for (int c = 0; c < 3; ++c) {
    for (Array* plane : {&behind_[c], &solved_[c][0], &solved_[c][1]})
      plane->assign(layout.sz, 0.0);
  }
  gamma_field_.assign(layout.size(), 0.0);
  for (int component : {0, 1}) {
    for (int b = 0; b < blocks(component); ++b)
      seen_[component].push_back(seenBy(metrics_, component, block(component, b)));
  }
}

int Momentum::blocks(int component) const {
  return (layout_.ny - metrics_.first(component, 1) + kRowsZ - 1) / kRowsZ;
}

LineRange Momentum::block(int component, int index) const {
  const int first = metrics_.first(component, 1) + index * kRowsZ;
  return {first, std::min(first + kRowsZ, layout_.ny) - 1, metrics_.first(component, 0),
          metrics_.last(component, 0)};
}

Lines Momentum::lines(const Velocity& vn, const Velocity& c, int component, double* reduced,
                      Velocity& v_star) {
  return {metrics_,
          step_,
          c,
          component,
          delta_.c[component].data(),
          reduced,
          gamma_field_.data() + layout_.at(0, 0, 0),
          layout_.sy,
          layout_.sz,
          behind_[component].data(),
          {solved_[component][0].data(), solved_[component][1].data()},
          vn.c[component].data(),
          v_star.c[component].data()};
}

void Momentum::prepare(const MomentumStep& step, const ExplicitSide& side) {
  step_ = step;
  first_ = true;
  const int kw = metrics_.grid.k_wing;
  team_.each(layout_.k0, layout_.k1, [&](int k, int thread) {
    for (int component = 0; component < 3; ++component) {
      if (k < metrics_.first(component, 2)) continue;
      double* delta = delta_.c[component].data();
      if (component == 2 && k == kw) {
        formWingPlane(metrics_, step_, side, delta, planes_[thread]);
      } else {
        solvePlane(metrics_, step_, side, component, k, delta, planes_[thread]);
      }
    }
  });
  if (!slab_.owns(kw)) return;
  const double* plane = delta_.c[2].data() + layout_.plane(kw);
  std::copy(plane, plane + layout_.sz, wing_plane_.begin());
}

void Momentum::solveBlock(Lines lines, const LineRange& range, const WallVelocity& wall_change,
                          int thread) {
  if (range.empty()) return;
  lines.gamma_row = (layout_.nz + 1) * layout_.sy;
  lines.gamma_plane = layout_.sy;
  lines.gamma = gammas_[thread].data() + 8 - range.first * lines.gamma_row;
  for (int half : {0, 1})
    lines.eliminate(range, half, lines.outermost(half), lines.innermost(half), wall_change);
  lines.join(range);
  for (int half : {0, 1}) lines.substitute(range, half);
}

/// The normal component: what does not see the wing's plane is eliminated once a step, in place.
void Momentum::finishNormal(const Lines& lines, const WallVelocity& wall_change) {
  const int kw = metrics_.grid.k_wing;
  team_.each(0, blocks(2), [&](int b, int) {
    const LineRange range = block(2, b);
    if (first_) {
      lines.eliminate(range, 0, lines.outermost(0), lines.innermost(0), wall_change);
      lines.eliminate(range, 1, lines.outermost(1), kw + 1, wall_change);
    }
    lines.eliminate(range, 1, kw, kw, wall_change);
    lines.join(range);
    for (int half : {0, 1}) lines.substitute(range, half);
  });
}

void Momentum::finish(const Velocity& vn, const Velocity& c, const WallVelocity& wall_change,
                      Velocity& v_star) {
  const int kw = metrics_.grid.k_wing;
  auto solveWing = [&](int thread) {
    double* plane = delta_.c[2].data() + layout_.plane(kw);
    std::copy(wing_plane_.begin(), wing_plane_.end(), plane);
    solveWingPlane(metrics_, step_, c, wall_change, delta_.c[2].data(), planes_[thread]);
  };
  if (slab_.ranks() > 1) {
    if (slab_.owns(kw)) solveWing(0);
    for (int component = 0; component < 3; ++component)
      finishSlabs(lines(vn, c, component, v_star.c[component].data(), v_star), wall_change);
    return;
  }
  const int ends[] = {1, 1 + blocks(0), 1 + blocks(0) + blocks(1)};
  const Lines u = lines(vn, c, 0, v_star.c[0].data(), v_star);
  const Lines v = lines(vn, c, 1, v_star.c[1].data(), v_star);
  team_.each(0, ends[2], [&](int task, int thread) {
    if (task == 0) return solveWing(thread);
    const int component = task < ends[1] ? 0 : 1, b = task - ends[component];
    solveBlock(component == 0 ? u : v, first_ ? block(component, b) : seen_[component][b],
               wall_change, thread);
  });
  finishNormal(lines(vn, c, 2, delta_.c[2].data(), v_star), wall_change);
  first_ = false;
}

}  // namespace monarch_flight::fluid::momentum
