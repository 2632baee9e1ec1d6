#include "panel/run_progress.h"

namespace monarch_flight {
namespace {

constexpr std::chrono::seconds kWindow{3};         // over which speed is measured
constexpr std::chrono::milliseconds kBetween{20};  // of the steps that are kept
constexpr std::chrono::seconds kLately{2};
constexpr int kPauses = 10;  // a wait that is so many times longer than usual

double secondsBetween(RunProgress::Clock::time_point begin, RunProgress::Clock::time_point end) {
  return std::chrono::duration<double>(end - begin).count();
}

}  // namespace

void RunProgress::add(std::uint32_t step, double time, Clock::time_point now) {
  if (known() && (step < steps_.back().step || paused(now))) clear();  // set back, played again
  // The newest step replaces the one before, where that came just behind its own predecessor.
  const std::size_t n = steps_.size();
  if (n >= 2 && steps_[n - 1].at - steps_[n - 2].at < kBetween) steps_.pop_back();
  steps_.push_back({step, time, now});
  while (steps_.size() > 2 && now - steps_[1].at > kWindow) steps_.pop_front();
}

/// Whether much more time has gone by than between the steps before.
bool RunProgress::paused(Clock::time_point now) const {
  const auto gap = now - steps_.back().at;
  const auto usual = (steps_.back().at - steps_.front().at) / static_cast<long>(steps_.size());
  return steps_.size() > 1 && gap > kLately && gap > kPauses * usual;
}

void RunProgress::clear() { steps_.clear(); }

double RunProgress::flap() const {
  return time_.period > 0.0 ? step() * time_.dt / time_.period : 0.0;
}

double RunProgress::flaps() const {
  return time_.period > 0.0 ? time_.steps * time_.dt / time_.period : 0.0;
}

bool RunProgress::moves(Clock::time_point now) const {
  return known() && now - steps_.back().at < kLately;
}

std::optional<double> RunProgress::realTimeFactor() const {
  if (steps_.size() < 2) return std::nullopt;
  const double wall = secondsBetween(steps_.front().at, steps_.back().at);
  if (wall <= 0.0) return std::nullopt;
  return (steps_.back().time - steps_.front().time) / wall;
}

std::optional<double> RunProgress::left() const {
  const std::optional<double> factor = realTimeFactor();
  if (!factor || *factor <= 0.0 || time_.steps < step()) return std::nullopt;
  return (time_.steps - step()) * time_.dt / *factor;
}

}  // namespace monarch_flight
