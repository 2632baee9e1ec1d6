#pragma once
#include <visualization_msgs/MarkerArray.h>

#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/run/pressure_reference.h"

namespace monarch_flight {

/// Colours run from -kPressureRange (blue) to +kPressureRange (red).
constexpr double kPressureRange = 1.0;

/// Both sides of a wing as triangles coloured by Cp, in the frame of that wing; the sides lie
/// `lift` [m] off its plane. The pressure of the left wing is given as its mirror image. Locked to
/// the frame: it moves with the wing until the next picture.
visualization_msgs::Marker pressureMarker(const SurfacePressure& surface, Side side,
                                          const PressureReference& reference, double lift,
                                          const ros::Time& stamp);

/// Colour bar with numbers, upright, in front of the insect, in the frame pressure_legend. `span`
/// is the wing's span [m]: all sizes scale with it.
visualization_msgs::MarkerArray pressureLegend(const PressureReference& reference, double span);

}  // namespace monarch_flight
