#include "monarch_flight/run/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "monarch_flight/math/seconds_since.h"

namespace monarch_flight {
namespace {

constexpr int kBar = 20;
constexpr std::chrono::milliseconds kRedraw{100};

}  // namespace

std::string clockText(double seconds) {
  const long s = std::lround(seconds);
  char text[48];
  if (s >= 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
  return text;
}

ProgressSink::ProgressSink(std::ostream& out, bool terminal, const TimeGrid& time)
    : out_(out), terminal_(terminal), time_(time) {}

void ProgressSink::onStep(const CommittedStep& step) {
  const auto now = std::chrono::steady_clock::now();
  if (!first_) {
    first_ = step.step;
    begin_ = now;
    if (step.step < time_.steps) return;
  }
  if (terminal_) {
    if (step.step != time_.steps && now - drawn_ < kRedraw) return;
    drawn_ = now;
    std::string text = line(step);
    const std::size_t width = text.size();
    if (width < width_) text.append(width_ - width, ' ');
    width_ = width;
    out_ << '\r' << text << std::flush;
  } else if (std::uint64_t{10} * step.step >= std::uint64_t{next_tenth_} * time_.steps) {
    next_tenth_ = static_cast<std::uint32_t>(std::uint64_t{10} * step.step / time_.steps) + 1;
    out_ << line(step) << std::endl;
  }
}

void ProgressSink::onReset() {
  next_tenth_ = 1;
  first_.reset();
  if (!terminal_) out_ << "set back to the start" << std::endl;
}

void ProgressSink::onEnd(const std::string&) {
  if (terminal_ && width_ > 0) out_ << std::endl;
}

std::string ProgressSink::line(const CommittedStep& step) const {
  const double done = static_cast<double>(step.step) / std::max(time_.steps, 1u);
  const double elapsed = secondsSince(begin_);
  std::string text = "[";
  for (int i = 0; i < kBar; ++i) text += i < done * kBar ? '#' : '.';
  char rest[160];
  std::snprintf(rest, sizeof rest, "] %3.0f %%  ", 100.0 * done);
  text += rest;
  if (time_.period > 0.0) {
    std::snprintf(rest, sizeof rest, "flap %.2f/%.4g  ", step.step * time_.dt / time_.period,
                  time_.steps * time_.dt / time_.period);
    text += rest;
  }
  std::snprintf(rest, sizeof rest, "step %u/%u  sub-iterations %zu  left ", step.step, time_.steps,
                step.iterations.size());
  const double flown = step.step - *first_, left = time_.steps - step.step;
  text += rest + clockText(elapsed * left / std::max(flown, 1.0));
  std::snprintf(rest, sizeof rest, "  %.2g of real time",
                flown * time_.dt / std::max(elapsed, 1e-9));
  return text + rest;
}

}  // namespace monarch_flight
