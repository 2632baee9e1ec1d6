#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>

#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// Seconds as h:mm:ss or m:ss.
std::string clockText(double seconds);

/// Shows flap, step, sub-iterations, time left and flight time over wall time: one line redrawn on
/// a terminal (at most ten times a second), else a plain line after every tenth of the run.
class ProgressSink : public StepSink {
 public:
  /// `out` must outlive the sink; `terminal` says whether a line can be redrawn on it.
  ProgressSink(std::ostream& out, bool terminal, const TimeGrid& time);
  void onStep(const CommittedStep& step) override;
  void onReset() override;
  void onEnd(const std::string& failure) override;

 private:
  std::string line(const CommittedStep& step) const;

  std::ostream& out_;
  bool terminal_;
  TimeGrid time_;
  std::chrono::steady_clock::time_point begin_, drawn_;
  std::uint32_t next_tenth_ = 1;
  std::optional<std::uint32_t> first_;  // step at begin_: 0, or the first after a resumption
  std::size_t width_ = 0;               // of the line on the terminal
};

}  // namespace monarch_flight
