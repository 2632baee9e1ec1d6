#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "monarch_flight/fluid/grid_settings.h"
#include "monarch_flight/fluid/mobility.h"
#include "monarch_flight/insect/planform.h"

namespace monarch_flight {

/// One direction of the tensor-product grid: n cells between n+1 faces [m].
struct Axis {
  std::vector<double> face;    ///< n+1, strictly increasing
  std::vector<double> centre;  ///< n, midpoints
  std::vector<double> width;   ///< n, face[i+1] - face[i]
  std::vector<double> gap;     ///< n+1: gap[i] = centre[i] - centre[i-1]; the ends: centre to outer
                               ///< face (half a width)
  int n() const { return static_cast<int>(centre.size()); }
  static Axis fromFaces(std::vector<double> faces);
};

/// Staggered grid fixed to the wing: x chord, y span, z normal (wing axes), wing in the plane z =
/// 0. Cells (i, j, k), i fastest. Immutable.
struct Grid {
  Axis x, y, z;
  int k_wing = 0;     ///< z.face[k_wing] == 0: the wing's plane; k_wing cells lie below it
  bool open = false;  ///< outer boundary: false: v = 0 (Neumann p); true: p = 0 (Dirichlet)
  std::vector<std::uint8_t>
      wing;  ///< nx*ny: 1 where the z-face (i, j, k_wing) belongs to the wing (a staircase)
  Mobility mobility;  ///< of the faces near the wing, from the mask
  long cells() const { return long(x.n()) * y.n() * z.n(); }
  bool isWing(int i, int j) const { return wing[static_cast<std::size_t>(j) * x.n() + i] != 0; }
};

/// Lays the grid out around a planform. Uniform spacing over the wing and `margin`, geometric
/// stretching outside, symmetric in z. Throws InputError when the wing gets fewer than 4 cells a
/// chord or does not fit.
Grid makeGrid(const Planform& planform, const GridSettings& settings);
/// Same with explicit axes (tests, plates of any kind); `wing` may be all 0 (no wing).
Grid makeGrid(Axis x, Axis y, Axis z, int k_wing, bool open, std::vector<std::uint8_t> wing);

}  // namespace monarch_flight
