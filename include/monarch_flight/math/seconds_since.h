#pragma once
#include <chrono>

namespace monarch_flight {

/// Wall time since `begin` [s].
inline double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace monarch_flight
