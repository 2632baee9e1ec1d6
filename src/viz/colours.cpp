#include "monarch_flight/viz/colours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace monarch_flight {

std_msgs::ColorRGBA divergingColour(double value) {
  // Equally spaced stops of ColorBrewer's RdBu, reversed.
  static constexpr std::array<std::array<float, 3>, 7> kStops = {{{0.13f, 0.40f, 0.67f},
                                                                  {0.40f, 0.66f, 0.81f},
                                                                  {0.82f, 0.90f, 0.94f},
                                                                  {0.97f, 0.97f, 0.97f},
                                                                  {0.99f, 0.86f, 0.78f},
                                                                  {0.94f, 0.54f, 0.38f},
                                                                  {0.70f, 0.09f, 0.17f}}};
  const double s = 3.0 * (std::clamp(value, -1.0, 1.0) + 1.0);
  const std::size_t i = std::min<std::size_t>(5, static_cast<std::size_t>(s));
  const float f = static_cast<float>(s - static_cast<double>(i));
  std_msgs::ColorRGBA out;
  out.r = kStops[i][0] + f * (kStops[i + 1][0] - kStops[i][0]);
  out.g = kStops[i][1] + f * (kStops[i + 1][1] - kStops[i][1]);
  out.b = kStops[i][2] + f * (kStops[i + 1][2] - kStops[i][2]);
  out.a = 1.0f;
  return out;
}

}  // namespace monarch_flight
