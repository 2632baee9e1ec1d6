#include "fluid/processes/time_limit.h"

#include <unistd.h>

#include <chrono>
#include <iostream>
#include <utility>

#include "fluid/processes/quiet_thread.h"

namespace monarch_flight::fluid::processes {

TimeLimit::TimeLimit(double seconds, std::string text) {
  thread_ = quietThread([this, seconds, text = std::move(text)] {
    std::unique_lock<std::mutex> lock(lock_);
    const std::chrono::duration<double> limit(seconds);
    if (wake_.wait_for(lock, limit, [this] { return over_; })) return;
    std::cerr << text + "\n" << std::flush;
    _exit(1);
  });
}

TimeLimit::~TimeLimit() {
  {
    const std::lock_guard<std::mutex> lock(lock_);
    over_ = true;
    wake_.notify_one();
  }
  thread_.join();
}

}  // namespace monarch_flight::fluid::processes
