#pragma once
#include "fluid/momentum/metrics.h"
#include "fluid/momentum/stencil.h"

namespace monarch_flight::fluid::momentum {

/// Where the wing lies between two points each of them sees the wall at half a cell instead of the
/// other: factors of the shares of RimFriction.
struct WallLinks {
  double wall;    ///< a nu / (half a cell x width), with the wall
  double beyond;  ///< a nu / (distance x width), with the point beyond, which goes
};

/// Of the points of u or v in plane k = k_wing - 1 or k_wing.
inline WallLinks wallLinks(const Metrics& m, const MomentumStep& step, int component, int k) {
  const double width = m.grid.z.width[k], friction = step.a * step.nu;
  const Metrics::Direction& axis = m.axis[component][2];
  return {2 * friction / (width * width),
          friction * axis.inverse_distance[m.grid.k_wing] * axis.inverse_width[k]};
}

}  // namespace monarch_flight::fluid::momentum
