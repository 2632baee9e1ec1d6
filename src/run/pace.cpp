#include "monarch_flight/run/pace.h"

#include <algorithm>

namespace monarch_flight {
namespace {

// A step that is late by no more than this is caught up with: waits end a little late.
constexpr std::chrono::milliseconds kCaughtUp{50};
constexpr double kLongest = 86400.0;  // a step [s]; longer ones would not fit into the clock

}  // namespace

Pace::Pace(double rate, double dt)
    : period_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(rate > 0.0 ? std::min(dt / rate, kLongest) : 0.0))) {}

void Pace::begin(std::uint32_t step, Clock::time_point now) {
  if (step == step_) return;
  step_ = step;
  due_ = std::max(due_, now - kCaughtUp) + period_;
}

}  // namespace monarch_flight
