#pragma once
#include <chrono>
#include <cstdint>

namespace monarch_flight {

/// Keeps a flight from going faster than a share of real time, for whoever watches or leads it. A
/// flight that is slower is not held up, and what was lost to a pause is not caught up with.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// `rate`: flight time over wall time, at most; 0: as fast as it goes. `dt`: of a step [s].
  Pace(double rate, double dt);
  /// Wall time until a step may begin; 0 or less: now.
  Clock::duration left(Clock::time_point now) const { return due_ - now; }
  /// A step begins; only the first call for the same step counts.
  void begin(std::uint32_t step, Clock::time_point now);

 private:
  Clock::duration period_;
  Clock::time_point due_;
  std::uint32_t step_ = 0;
};

}  // namespace monarch_flight
