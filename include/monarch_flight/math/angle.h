#pragma once
#include <vector>

/// Angles are in radians everywhere; degrees are for people and for files.
namespace monarch_flight {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kDegree = kPi / 180.0;  ///< one degree [rad]

inline std::vector<double> inRadians(std::vector<double> degrees) {
  for (double& angle : degrees) angle *= kDegree;
  return degrees;
}

}  // namespace monarch_flight
