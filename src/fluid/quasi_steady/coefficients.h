#pragma once
#include "monarch_flight/fluid/quasi_steady.h"

namespace monarch_flight::fluid::quasi_steady {

/// Steady coefficients of one section for the direction it moves in.
struct SectionCoefficients {
  double lift = 0.0;  ///< along the normal of the motion, >= 0: side see blade_element.cpp
  double drag = 0.0;  ///< against the motion, > 0
  double centre_of_pressure = 0.0;  ///< distance behind the leading edge [chords], 0..1
};

/// `alpha` is the angle from the direction root-to-leading-edge (x of the wing axes) to the
/// velocity of the section through the air, without its sign [rad], in [0, pi]: 0 leading edge
/// forward, pi/2 broadside, pi trailing edge forward. A flat section cannot tell its edges apart,
/// so lift and drag depend on the acute angle alone. Continuous in alpha. Sources:
/// docs/quasi_steady.md, section 2.
SectionCoefficients sectionCoefficients(BladeElementVariant variant, double alpha);

/// Coefficient of the drag of elements of the chord in pure rotation about the reference point.
double rotationalDampingCoefficient(BladeElementVariant variant);

}  // namespace monarch_flight::fluid::quasi_steady
