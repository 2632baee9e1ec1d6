#pragma once
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// Where a flight is and how fast it goes, from the steps as they come, of a run or of its bag.
class RunProgress {
 public:
  using Clock = std::chrono::steady_clock;

  /// The times of the case that is flown.
  void setTime(const TimeGrid& time) { time_ = time; }
  /// Step `step` has come; `time`: since step 0 [s].
  void add(std::uint32_t step, double time, Clock::time_point now);
  /// Forgets the steps.
  void clear();

  bool known() const { return !steps_.empty(); }
  std::uint32_t step() const { return known() ? steps_.back().step : 0; }
  std::uint32_t steps() const { return time_.steps; }
  double time() const { return known() ? steps_.back().time : 0.0; }  ///< since step 0 [s]
  double flap() const;                                                ///< flown; 0 without a period
  double flaps() const;  ///< of the whole run; 0 without a period
  bool complete() const { return known() && time_.steps > 0 && step() >= time_.steps; }
  /// Whether steps have come lately.
  bool moves(Clock::time_point now) const;
  /// Flight time over wall time, of the last seconds; none before there are two steps.
  std::optional<double> realTimeFactor() const;
  /// Wall time to the end of the run at this speed [s].
  std::optional<double> left() const;

 private:
  struct Step {
    std::uint32_t step;
    double time;
    Clock::time_point at;
  };
  bool paused(Clock::time_point now) const;

  TimeGrid time_;
  std::deque<Step> steps_;  // of the last seconds
};

}  // namespace monarch_flight
