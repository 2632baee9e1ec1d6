#include "monarch_flight/coupling/companion.h"

namespace monarch_flight {

Companion::Companion() : thread_([this] { work(); }) {}

Companion::~Companion() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Companion::both(const std::function<void()>& mine, const std::function<void()>& theirs) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    task_ = &theirs;
    failure_ = nullptr;
  }
  changed_.notify_all();
  std::exception_ptr own;
  try {
    mine();
  } catch (...) {
    own = std::current_exception();
  }
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return task_ == nullptr; });
  if (own) std::rethrow_exception(own);
  if (failure_) std::rethrow_exception(failure_);
}

void Companion::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return over_ || task_ != nullptr; });
    if (over_) return;
    const std::function<void()>& task = *task_;
    std::exception_ptr failure;
    lock.unlock();
    try {
      task();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    failure_ = failure;
    task_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace monarch_flight
