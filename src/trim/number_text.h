#pragma once
#include <cstdio>
#include <string>

namespace monarch_flight {

/// A number for people, with so many significant digits at most.
inline std::string number(double value, int digits = 6) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace monarch_flight
