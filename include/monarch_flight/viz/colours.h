#pragma once
#include <monarch_flight/ColourScale.h>
#include <std_msgs/ColorRGBA.h>

#include <cstddef>
#include <deque>
#include <string>

namespace monarch_flight {

/// A scale of colours: from a number in [-1, 1] (clamped outside).
using Palette = std_msgs::ColorRGBA (*)(double value);
/// Of pressure: blue at -1, near white at 0, red at +1.
std_msgs::ColorRGBA pressureColour(double value);
/// Of vorticity: teal at -1, near white at 0, orange at +1. Neither hue is one of pressure's.
std_msgs::ColorRGBA vorticityColour(double value);

/// For a legend.
ColourScale colourScale(const std::string& quantity, const std::string& unit, double limit,
                        Palette palette);

/// Where the scale of a quantity ends: at the largest value of the last pictures, rounded up to 1,
/// 1.5, 2, 3, 5 or 7 times a power of ten, so that colours change seldom.
class ScaleLimit {
 public:
  /// `pictures`: how many are remembered.
  explicit ScaleLimit(std::size_t pictures = 64) : pictures_(pictures) {}
  /// `largest`: of a new picture.
  void add(double largest);
  double value() const { return value_; }  ///< 1 before the first picture

 private:
  std::size_t pictures_;
  std::deque<double> largest_;
  double value_ = 1.0;
};

}  // namespace monarch_flight
