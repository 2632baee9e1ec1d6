#pragma once
#include <chrono>
#include <optional>
#include <string>

#include "monarch_flight/ros_io/run_names.h"

namespace monarch_flight {

/// rviz, for which a flight waits before its first step (rviz:=true), so that all of the flight is
/// seen.
class Audience {
 public:
  /// `awaited`: whether rviz was started with the run; else nobody is waited for.
  Audience(const RunNames& names, bool awaited);
  /// Whether the flight may begin: rviz listens to the run's topics, or has not come in time, which
  /// is told. Asks the master now and then.
  bool ready();

 private:
  using Clock = std::chrono::steady_clock;
  bool rvizListens() const;

  RunNames names_;
  bool ready_;
  std::optional<Clock::time_point> begin_;  // of the wait
  Clock::time_point asked_;
};

}  // namespace monarch_flight
