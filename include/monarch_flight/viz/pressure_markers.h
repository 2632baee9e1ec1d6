#pragma once
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/insect.h"
#include "monarch_flight/run/pressure_reference.h"

namespace monarch_flight {

/// Colours run from -kPressureRange (blue) to +kPressureRange (red).
constexpr double kPressureRange = 1.0;

/// Both sides of the right wing as triangles coloured by Cp in frame right_wing and, unless a bare
/// wing, of the left one in left_wing; the sides lie `lift` [m] off the wing's plane. Locked to
/// the frames: they move with the wings until the next picture.
visualization_msgs::MarkerArray pressureMarkers(const PerWing<SurfacePressure>& surface,
                                                const PressureReference& reference, bool bare_wing,
                                                double lift, const ros::Time& stamp);

/// Colour bar with numbers, upright in world, in front of the insect; moves with base_link. `span`
/// is the wing's span [m] (all sizes scale with it), `R_WB` takes base_link components to world
/// components.
visualization_msgs::MarkerArray pressureLegend(const PressureReference& reference, double span,
                                               const Eigen::Matrix3d& R_WB, const ros::Time& stamp);

}  // namespace monarch_flight
