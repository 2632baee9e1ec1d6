#pragma once
#include <Eigen/Dense>

#include "fluid/fields/field.h"
#include "fluid/fields/team.h"
#include "monarch_flight/insect/state.h"

namespace monarch_flight::fluid {

/// Velocity of the grid at one instant: v_g(r) = V + omega x r, wing axes.
struct GridVelocity {
  Eigen::Vector3d V = Eigen::Vector3d::Zero();
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  double at(int component, double x, double y, double z) const {
    switch (component) {
      case 0:
        return V.x() + omega.y() * z - omega.z() * y;
      case 1:
        return V.y() + omega.z() * x - omega.x() * z;
      default:
        return V.z() + omega.x() * y - omega.y() * x;
    }
  }
};

/// Where the wing is: wing axes to inertial ones.
Eigen::Isometry3d placeOf(const WingMotion& motion);
/// v_g of the wing's motion.
GridVelocity gridVelocity(const WingMotion& motion);
/// v_g in the plane z = 0.
WallVelocity wallVelocity(const GridVelocity& g);
/// Same vector field, resolved in axes turned by Q (components_new = Q components_old).
WallVelocity rotated(const WallVelocity& w, const Eigen::Matrix3d& Q);
/// Component-wise a * x + b * y + c * z.
WallVelocity combined(double a, const WallVelocity& x, double b, const WallVelocity& y, double c,
                      const WallVelocity& z);

/// out = Q in at every interior face: velocity resolved in axes turned by Q. Each component keeps
/// its own faces; the other two are averaged to them, so a uniform field is turned exactly. Ghosts
/// and outer faces of `out` stay as they are.
void rotateField(const Layout& l, const Team& team, const Eigen::Matrix3d& Q, const Velocity& in,
                 Velocity& out);

}  // namespace monarch_flight::fluid
