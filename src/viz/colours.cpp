#include "monarch_flight/viz/colours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace monarch_flight {
namespace {

// Stops at equal distances from -1 to 1.
using Stops = std::array<std::array<float, 3>, 7>;

std_msgs::ColorRGBA between(const Stops& stops, double value) {
  const double s = 3.0 * (std::clamp(value, -1.0, 1.0) + 1.0);
  const std::size_t i = std::min<std::size_t>(5, static_cast<std::size_t>(s));
  const float f = static_cast<float>(s - static_cast<double>(i));
  std_msgs::ColorRGBA out;
  out.r = stops[i][0] + f * (stops[i + 1][0] - stops[i][0]);
  out.g = stops[i][1] + f * (stops[i + 1][1] - stops[i][1]);
  out.b = stops[i][2] + f * (stops[i + 1][2] - stops[i][2]);
  out.a = 1.0f;
  return out;
}

}  // namespace

std_msgs::ColorRGBA pressureColour(double value) {
  // ColorBrewer's RdBu, reversed.
  static constexpr Stops kStops = {{{0.13f, 0.40f, 0.67f},
                                    {0.40f, 0.66f, 0.81f},
                                    {0.82f, 0.90f, 0.94f},
                                    {0.97f, 0.97f, 0.97f},
                                    {0.99f, 0.86f, 0.78f},
                                    {0.94f, 0.54f, 0.38f},
                                    {0.70f, 0.09f, 0.17f}}};
  return between(kStops, value);
}

std_msgs::ColorRGBA vorticityColour(double value) {
  // ColorBrewer's BrBG, reversed, its brown made orange.
  static constexpr Stops kStops = {{{0.00f, 0.40f, 0.37f},
                                    {0.21f, 0.59f, 0.56f},
                                    {0.60f, 0.82f, 0.78f},
                                    {0.93f, 0.93f, 0.90f},
                                    {0.98f, 0.82f, 0.52f},
                                    {0.95f, 0.60f, 0.20f},
                                    {0.80f, 0.36f, 0.03f}}};
  return between(kStops, value);
}

ColourScale colourScale(const std::string& quantity, const std::string& unit, double limit,
                        Palette palette) {
  constexpr int kColours = 33;
  ColourScale out;
  out.quantity = quantity;
  out.unit = unit;
  out.limit = limit;
  for (int i = 0; i < kColours; ++i) out.colours.push_back(palette(2.0 * i / (kColours - 1) - 1.0));
  return out;
}

void ScaleLimit::add(double largest) {
  largest_.push_back(largest);
  if (largest_.size() > pictures_) largest_.pop_front();
  const double most = *std::max_element(largest_.begin(), largest_.end());
  if (!(most > 0.0)) return;
  const double ten = std::pow(10.0, std::floor(std::log10(most)));
  for (double round : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0}) {
    value_ = round * ten;
    if (value_ >= most * (1.0 - 1e-9)) return;
  }
}

}  // namespace monarch_flight
