#pragma once
#include <Eigen/Dense>
#include <functional>

#include "fluid/fields/field.h"
#include "fluid/fields/slab.h"
#include "fluid/fields/team.h"

namespace monarch_flight::fluid {

/// Fields without ghosts (b, phi) hold the cells of this process: nx * ny * (k1 - k0), x fastest.

/// b = scale * net outflow of each cell.
void netOutflow(const Grid& grid, const Layout& l, const Team& team, const Velocity& v,
                double scale, double* b);
/// v -= scale grad phi on all faces but the wing's; outer faces too when the boundary is open.
/// In front of phi stands the plane k0 - 1 of the process below (unused at the bottom).
void subtractGradient(const Grid& grid, const Layout& l, const Team& team, const double* phi,
                      double scale, Velocity& v);
/// Outer faces and ghosts of this process's planes: zero (rest), or no
/// change along the normal (open).
void fillOuter(const Grid& grid, const Layout& l, Velocity& v);
/// Outer faces and ghosts (which lie on the outer faces, too) take the component of `field` there;
/// position in wing axes.
void fillOuter(const Grid& grid, const Layout& l,
               const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& field, Velocity& v);
/// Position of the point (i, j, k) of a component; indices -1 and n of a centre mean the outer
/// face.
Eigen::Vector3d pointOf(const Grid& grid, int component, int i, int j, int k);
/// The wing's own faces take the wall's normal velocity.
void fillWing(const Grid& grid, const Layout& l, const WallVelocity& wall, Velocity& v);
/// Largest |net outflow| of a cell divided by its largest face flux scale; 0 for air at rest.
double relativeDivergence(const Grid& grid, const Layout& l, const Velocity& v);
/// The same over the slabs of all processes.
double relativeDivergence(const Grid& grid, const Layout& l, const Slab& slab, const Velocity& v);

}  // namespace monarch_flight::fluid
