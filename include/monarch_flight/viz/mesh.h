#pragma once
#include <array>
#include <string>
#include <vector>

#include "monarch_flight/insect/planform.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// Triangles of a surface, for pictures [m].
struct Mesh {
  std::vector<std::array<Eigen::Vector3f, 3>> triangles;
};

/// Both sides of a wing in its own axes; `left` gives the mirror image (y < 0).
Mesh wingMesh(const Planform& planform, bool left, int stations = 80);
/// Ellipsoid with full axes `length` (x) and `width` (y and z) around `centre`.
Mesh ellipsoidMesh(const Eigen::Vector3d& centre, double length, double width);
/// Binary STL of the mesh, little endian.
std::string stlBytes(const Mesh& mesh);

}  // namespace monarch_flight
