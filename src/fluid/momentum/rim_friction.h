#pragma once
#include "fluid/fields/field.h"

namespace monarch_flight::fluid::momentum {

/// Friction beside the wing: what part of the wall each point above and below it sees, and how much
/// more than a difference of point values the friction beside the rim is.
///
/// Within a cell of a sharp edge every flow is slow. There it goes as sqrt(r) (Stokes' equations
/// round a half-plane), its friction as 1 / sqrt(r), and central differences miss its mean over a
/// face beside the rim by fixed factors: a plate acts as if it were 0.2 to 0.3 cells smaller all
/// round, an error of first order in all loads. The factors are functions of the cell's aspect
/// (height by width) alone: exact ratios of the singular solutions, and for flow round the edge one
/// number that stands for the faces farther away, too.
class RimFriction {
 public:
  RimFriction(const Grid& grid, const Layout& layout);

  /// Of the points (., j) of u or v (`component` 0, 1) in plane k_wing - 1 (`side` 0) or k_wing:
  /// the share of their face in the wing's plane that feels the wall, by a difference over half a
  /// cell; about 1 inside the outline, 0 outside.
  const double* wall(int component, int side, int j) const {
    return row(wall_[component][side], j);
  }
  /// The share of their link with the point beyond the wing's plane that is cut.
  const double* cut(int component, int side, int j) const { return row(cut_[component][side], j); }

  /// Along x (`direction` 0) or y, (factor - 1) / distance of the links with the lower neighbours
  /// of the points (., j) of a component; side 0 for w, whose points lie in the wing's plane.
  const double* extra(int component, int direction, int side, int j) const {
    return row(extra_[component][direction][side], j);
  }
  /// Whether the points of plane k have rows above.
  bool reaches(int component, int k) const {
    return k <= k_wing_ && k >= k_wing_ - (component != 2);
  }
  int side(int component, int k) const { return component == 2 ? 0 : k - k_wing_ + 1; }

  /// Mean friction by difference quotient. Flow round the edge: of its velocity normal to the wing,
  /// between the last point on the wing and the first one outside.
  static double roundEdge(double aspect);
  /// Flow along the wing, across its edge: of the point above the edge with the wall.
  static double overEdge(double aspect);
  /// Flow along the edge: of the last point inside with the wall, and with the first one outside.
  static double alongEdge(double aspect);
  static double besideEdge(double aspect);

 private:
  const double* row(const Array& plane, int j) const { return plane.data() + (j + 1) * sy_ + 8; }
  double* row(Array& plane, int j) { return plane.data() + (j + 1) * sy_ + 8; }
  void normalLinks(const Grid& grid);
  void tangentialLinks(const Grid& grid, int component, int side);

  std::ptrdiff_t sy_;
  int k_wing_;
  Array wall_[2][2], cut_[2][2];  ///< [component][side], one plane each
  Array extra_[3][2][2];          ///< [component][direction][side]
};

}  // namespace monarch_flight::fluid::momentum
