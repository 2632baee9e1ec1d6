#pragma once
#include <algorithm>

#include "fluid/fields/field.h"
#include "fluid/momentum/rim_friction.h"

namespace monarch_flight::fluid::momentum {

/// Constants of the momentum step on a grid. Component c has its points on the faces normal to c.
struct Metrics {
  Metrics(const Grid& grid, const Layout& layout);

  struct Direction {
    Array inverse_width;     ///< 1 / control-volume width, at the points of the component
    Array inverse_distance;  ///< 1 / distance to the lower neighbour; one entry more than points
  };

  /// First and last unknown of a component along a direction; along z those of this process.
  int first(int component, int direction) const {
    const int whole = component == direction ? 1 : 0;
    return direction == 2 ? std::max(whole, layout.k0) : whole;
  }
  int last(int, int direction) const {
    return (direction == 2 ? layout.k1 : layout.n(direction)) - 1;
  }
  double x(int component, int i) const {
    return component == 0 ? grid.x.face[i] : grid.x.centre[i];
  }
  double y(int component, int j) const {
    return component == 1 ? grid.y.face[j] : grid.y.centre[j];
  }

  const Grid& grid;
  const Layout& layout;
  Direction axis[3][3];  ///< [component][direction]
  RimFriction rim;
  Array zero;         ///< a row
  Array fourth_x[3];  ///< 1 / width where fourth differences along x reach, else 0
};

}  // namespace monarch_flight::fluid::momentum
