#pragma once
#include <visualization_msgs/MarkerArray.h>

#include "monarch_flight/insect/insect.h"

namespace monarch_flight {

/// The insect as triangles, each part in the frame with which it moves (viz/frames.h): the meshes
/// of the URDF inside messages, so that a bag alone shows it, on any machine.
visualization_msgs::MarkerArray modelMarkers(const Insect& insect);

}  // namespace monarch_flight
