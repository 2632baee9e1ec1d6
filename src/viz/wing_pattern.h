#pragma once
#include <visualization_msgs/Marker.h>

#include "monarch_flight/insect/planform.h"

namespace monarch_flight {

/// Whose wings these are: orange cells, dark veins and a dark border with white spots; or clear
/// wings with veins.
enum class WingLook { kMonarch, kClear };

/// Draws a wing into a list of triangles, in its own axes; `left` gives the mirror image (y < 0).
void addWing(const Planform& planform, bool left, WingLook look, visualization_msgs::Marker& out);

}  // namespace monarch_flight
