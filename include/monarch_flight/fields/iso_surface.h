#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "monarch_flight/fluid/flow_picture.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// Where Q has one value, in the axes of the picture: vertices shared by triangles.
struct IsoSurface {
  std::vector<Eigen::Vector3f> points;   ///< [m]
  std::vector<Eigen::Vector3f> normals;  ///< of length 1, to where Q is smaller
  std::vector<float> omega_y;            ///< vorticity along the span [1/s]
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Whether this build can make one: it has VTK.
bool hasIsoSurfaces();

/// The surface Q = q (> 0) [1/s^2] by VTK's flying edges, of the picture made a little softer. With
/// more than `most` triangles every second point of the picture is left out, and again, until there
/// are no more. Empty without VTK.
IsoSurface isoSurface(const FlowPicture& picture, double q, std::size_t most);

}  // namespace monarch_flight
