#pragma once
#include <visualization_msgs/Marker.h>

#include "monarch_flight/fields/iso_surface.h"
#include "monarch_flight/insect/state.h"

namespace monarch_flight {

/// How vortices are shown.
struct VortexLook {
  double limit = 1.0;               ///< colours run from -limit to limit [1/s]
  float opacity = 1.0f;             ///< 0 to 1; below 1 rviz draws triangles in any order
  Eigen::Vector3d light{0, 0, -1};  ///< from where it comes, in the axes of the wing; length 1
};

/// A large |vorticity along the span| of the points with Q > q: 85 % of them have less [1/s].
double largestVorticity(const FlowPicture& picture, double q);

/// Triangles coloured by the vorticity along the span, each vertex darkened a little away from the
/// light, as markers have no normals. `mirrored`: the image of the surface in the plane of
/// symmetry, as the other wing of a mirrored flight has it. They stay where the wing was: locked to
/// no frame.
visualization_msgs::Marker vortexMarker(const IsoSurface& surface, Side side, bool mirrored,
                                        const VortexLook& look, const ros::Time& stamp);

/// The vorticity along the span in a plane across it, at y = `at` (that of the picture's axes) [m].
visualization_msgs::Marker sliceMarker(const FlowPicture& picture, Side side, bool mirrored,
                                       double at, double limit, const ros::Time& stamp);

}  // namespace monarch_flight
