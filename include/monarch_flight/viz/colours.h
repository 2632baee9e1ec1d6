#pragma once
#include <std_msgs/ColorRGBA.h>

namespace monarch_flight {

/// Diverging colours: blue at -1, near white at 0, red at +1 (clamped outside).
std_msgs::ColorRGBA divergingColour(double value);

}  // namespace monarch_flight
