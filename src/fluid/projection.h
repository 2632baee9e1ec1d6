#pragma once
#include <Eigen/Dense>

#include "fluid/field.h"

namespace monarch_flight {

/// b = scale * net outflow of each cell [b: nx*ny*nz, no ghosts].
void netOutflow(const Grid& grid, const Layout& l, const Velocity& v, double scale, double* b);
/// v -= scale grad phi on all faces but the wing's; outer faces too when the boundary is open.
void subtractGradient(const Grid& grid, const Layout& l, const double* phi, double scale,
                      Velocity& v);
/// Outer faces and ghosts: the far field's uniform velocity (rest), or no change along the normal
/// (open).
void fillOuter(const Grid& grid, const Layout& l, const Eigen::Vector3d& far, Velocity& v);
/// The wing's own faces take the wall's normal velocity.
void fillWing(const Grid& grid, const Layout& l, const WallVelocity& wall, Velocity& v);
/// Largest |net outflow| of a cell divided by its largest face flux scale; 0 for air at rest.
double relativeDivergence(const Grid& grid, const Layout& l, const Velocity& v);

}  // namespace monarch_flight
