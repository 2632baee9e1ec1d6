#include "fluid/momentum/rim_friction.h"

#include <cmath>

namespace monarch_flight::fluid::momentum {
namespace {

/// The singular solution gives 2.25 / sqrt(aspect) for the face beside the rim alone. Those above
/// it miss a part of the friction, too, the more of them the flatter the cells: what a
/// two-dimensional plate normal to Stokes flow, 12 and 24 cells wide, needs to have its exact drag
/// is 0.95 + 1.5 / aspect within 1 % for aspects 0.25 to 1, a friction of 1.5 nu times the
/// difference of velocity along the rim whatever the cell's height.
constexpr double kRound = 1.5;

}  // namespace

// The edge is the origin, the wing at x < 0, z = 0; theta from the x axis; cells of width 1, the
// point's cell of height `aspect`.

// psi = r^(3/2) (cos(3 theta / 2) + 3 cos(theta / 2)), w = - dpsi / dx: at theta = 0 it is 6
// sqrt(r), 4 in the mean of the first face; its gradient along x at theta = pi / 2 is 9 / (2 sqrt(2
// r)).
double RimFriction::roundEdge(double aspect) { return 1 + kRound / aspect; }

// psi = r^(3/2) (sin(3 theta / 2) + sin(theta / 2)), u = dpsi / dz.
double RimFriction::overEdge(double aspect) { return std::sqrt(aspect); }

// v = sqrt(r) cos(theta / 2).
double RimFriction::alongEdge(double aspect) {
  const double r = 0.5 * std::hypot(1, aspect), theta = std::atan(aspect);
  return 0.5 * aspect / (std::sqrt(r) * std::sin(0.5 * theta));
}

double RimFriction::besideEdge(double aspect) {
  const double r = 0.5 * std::hypot(1, aspect), theta = std::atan(aspect);
  const double quotient = std::sqrt(r) * (std::cos(0.5 * theta) - std::sin(0.5 * theta));
  return 1 / std::sqrt(2 * aspect) / quotient;
}

RimFriction::RimFriction(const Grid& grid, const Layout& layout)
    : sy_(layout.sy), k_wing_(grid.k_wing) {
  for (int component = 0; component < 3; ++component) {
    for (int side = 0; side < (component == 2 ? 1 : 2); ++side) {
      for (auto& direction : extra_[component]) direction[side].assign(layout.sz, 0.0);
      if (component == 2) continue;
      wall_[component][side].assign(layout.sz, 0.0);
      cut_[component][side].assign(layout.sz, 0.0);
      tangentialLinks(grid, component, side);
    }
  }
  normalLinks(grid);
}

void RimFriction::normalLinks(const Grid& grid) {
  const double height = grid.z.gap[k_wing_];
  for (int j = 0; j < grid.y.n(); ++j) {
    for (int i = 0; i < grid.x.n(); ++i) {
      const double dx = grid.x.gap[i], dy = grid.y.gap[j];
      if (i > 0 && grid.isWing(i, j) != grid.isWing(i - 1, j))
        row(extra_[2][0][0], j)[i] = (roundEdge(height / dx) - 1) / dx;
      if (j > 0 && grid.isWing(i, j) != grid.isWing(i, j - 1))
        row(extra_[2][1][0], j)[i] = (roundEdge(height / dy) - 1) / dy;
    }
  }
}

/// Of u or v. `own`: the axis it is along, `across` the other one of the wing's plane.
void RimFriction::tangentialLinks(const Grid& grid, int component, int side) {
  const Axis& own = component == 0 ? grid.x : grid.y;
  const Axis& across = component == 0 ? grid.y : grid.x;
  const double height = grid.z.width[k_wing_ - 1 + side];
  auto wing = [&](int a, int b) {  // cell a along its own direction, b across
    if (a < 0 || b < 0 || a >= own.n() || b >= across.n()) return 0;
    return grid.isWing(component == 0 ? a : b, component == 0 ? b : a) ? 1 : 0;
  };
  auto inside = [&](int a, int b) { return wing(a - 1, b) + wing(a, b) == 2; };
  for (int b = 0; b < across.n(); ++b) {
    for (int a = 1; a < own.n(); ++a) {
      const int i = component == 0 ? a : b, j = component == 0 ? b : a;
      double &wall = row(wall_[component][side], j)[i], &cut = row(cut_[component][side], j)[i];
      if (inside(a, b)) {
        const bool last = !inside(a, b - 1) || !inside(a, b + 1);
        wall = last ? alongEdge(height / across.width[b]) : 1;
        cut = 1;
      } else if (wing(a - 1, b) + wing(a, b) == 1) {
        wall = overEdge(height / own.gap[a]);
        cut = 1 - 0.5 * wall;
      }
      if (b > 0 && inside(a, b) != inside(a, b - 1)) {
        const double distance = across.gap[b];
        row(extra_[component][1 - component][side], j)[i] =
            (besideEdge(height / distance) - 1) / distance;
      }
    }
  }
}

}  // namespace monarch_flight::fluid::momentum
