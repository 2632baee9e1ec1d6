#pragma once
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace monarch_flight::fluid::processes {

/// Ends the program with exit code 1 and `text` on stderr, unless this object goes within
/// `seconds`: for a single call that may never return.
class TimeLimit {
 public:
  TimeLimit(double seconds, std::string text);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

 private:
  std::mutex lock_;
  std::condition_variable wake_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace monarch_flight::fluid::processes
