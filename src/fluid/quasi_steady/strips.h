#pragma once
#include <vector>

#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/planform.h"

namespace monarch_flight::fluid::quasi_steady {

/// One blade element: a section of the wing at station y that stands for the span dy.
struct Strip {
  double y = 0.0;        ///< station, wing axes [m]
  double dy = 0.0;       ///< its share of the span [m]
  double edge = 0.0;     ///< inboard edge of that share [m]
  double chord = 0.0;    ///< > 0 [m]
  double leading = 0.0;  ///< x of the leading edge [m]
  double reference =
      0.0;  ///< x of the point whose velocity the coefficients see: the hinge line x = 0, or the
            ///< nearer edge where the hinge line passes the section by [m]
  double middle() const { return leading - 0.5 * chord; }  ///< x of mid-chord [m]
};

/// Gauss-Legendre stations of the span, split at the planform's breaks, at least `minimum` in all:
/// span integrals of polynomial sections are exact. Sections without chord are left out.
std::vector<Strip> makeStrips(const Planform& planform, int minimum);

/// Added mass about the wing root, wing axes: sum over the strips of the two-dimensional plate,
/// pi/4 rho c^2 against motion normal to the plate at mid-chord and pi/128 rho c^4 against rotation
/// about mid-chord. Symmetric, positive semidefinite; only v_z, omega_x and omega_y carry any.
Matrix6d stripAddedMass(const std::vector<Strip>& strips, double rho);

}  // namespace monarch_flight::fluid::quasi_steady
