#pragma once
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace monarch_flight {

/// A second pair of hands: a thread that does one piece of work at a time, beside its owner. It waits
/// asleep.
class Companion {
 public:
  Companion();
  ~Companion();
  Companion(const Companion&) = delete;
  Companion& operator=(const Companion&) = delete;

  /// Does `theirs` on the thread and `mine` here, at the same time; returns when both are done.
  /// Exceptions come out: that of `mine` first.
  void both(const std::function<void()>& mine, const std::function<void()>& theirs);

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* task_ = nullptr;  // being done
  std::exception_ptr failure_;                   // of the last one
  bool over_ = false;
  std::thread thread_;
};

}  // namespace monarch_flight
