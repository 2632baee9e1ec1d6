#include "monarch_flight/run/hold.h"

namespace monarch_flight {

std::string RunPlace::describe() const {
  std::string text = "step " + std::to_string(step);
  if (iteration > 0) {
    text +=
        ", sub-iteration " + std::to_string(iteration - 1) + " of step " + std::to_string(step + 1);
  }
  if (ended) return "the run is over" + (failure.empty() ? ": complete" : ": " + failure);
  return (held ? "held after " : "flying after ") + text;
}

RunPlace Hold::place() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return place_;
}

bool Hold::wanted() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return held_ || reset_ || checkpoint_;
}

/// Waits until `done`, or until the run is over or somebody asks for something else.
template <class Done>
RunPlace Hold::await(std::unique_lock<std::mutex>& lock, Done done) {
  const std::uint64_t mine = ++requests_;
  changed_.notify_all();
  changed_.wait(lock, [&] { return done() || place_.ended || requests_ != mine; });
  return place_;
}

RunPlace Hold::pause() {
  std::unique_lock<std::mutex> lock(mutex_);
  held_ = true;
  return await(lock, [this] { return place_.held; });
}

void Hold::pauseSoon() {
  const std::lock_guard<std::mutex> lock(mutex_);
  held_ = true;
}

RunPlace Hold::resume() {
  std::unique_lock<std::mutex> lock(mutex_);
  held_ = once_ = false;
  hold_behind_ = kNever;
  return await(lock, [this] { return !place_.held; });
}

void Hold::flyUntil(std::uint32_t step) {
  const std::lock_guard<std::mutex> lock(mutex_);
  held_ = once_ = false;
  place_.held = false;
  hold_behind_ = step;
}

RunPlace Hold::letGo(std::uint32_t count, bool once) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!place_.held || place_.ended) return place_;
  held_ = place_.held = false;
  once_ = once;
  hold_behind_ = count < kNever - place_.step ? place_.step + count : kNever;
  return await(lock, [this] { return place_.held; });
}

RunPlace Hold::steps(std::uint32_t count) { return letGo(count, false); }

RunPlace Hold::subIterate() { return letGo(kNever, true); }

RunPlace Hold::reset() {
  std::unique_lock<std::mutex> lock(mutex_);
  reset_ = true;
  const std::uint64_t before = resets_;
  return await(lock, [this, before] { return resets_ > before && place_.held == held_; });
}

RunPlace Hold::checkpoint() {
  std::unique_lock<std::mutex> lock(mutex_);
  checkpoint_ = true;
  const std::uint64_t before = checkpoints_;
  changed_.wait(lock, [&] { return checkpoints_ > before || place_.ended; });
  return checkpoints_ > before ? kept_ : place_;
}

RunControl::Order Hold::next(std::uint32_t step, std::uint32_t iteration, const StopFlag& stop,
                             const std::function<void(const RunPlace&)>& idle) {
  std::unique_lock<std::mutex> lock(mutex_);
  place_.step = step - 1;
  place_.iteration = iteration;
  resets_ += resetting_ ? 1 : 0;
  resetting_ = false;
  checkpoints_ += checkpointing_ ? 1 : 0;
  if (checkpointing_) {  // nothing has been flown since the last call
    checkpointing_ = false;
  } else if (once_ || place_.step >= hold_behind_) {
    held_ = true;
    once_ = false;
    hold_behind_ = kNever;
  }
  while (held_ && !reset_ && !checkpoint_ && !stop) {
    place_.held = true;
    changed_.notify_all();
    const RunPlace place = place_;
    lock.unlock();
    idle(place);
    lock.lock();
  }
  if (checkpoint_ && !reset_ && !stop) {  // a held run stays held
    checkpoint_ = false;
    checkpointing_ = true;
    kept_ = place_;
    return RunControl::Order::kCheckpoint;
  }
  place_.held = false;
  changed_.notify_all();
  if (stop) return RunControl::Order::kStop;
  if (!reset_) return RunControl::Order::kGoOn;
  reset_ = false;
  resetting_ = true;
  return RunControl::Order::kReset;
}

void Hold::committed(std::uint32_t step) {
  const std::lock_guard<std::mutex> lock(mutex_);
  place_.step = step;
  place_.iteration = 0;
}

void Hold::end(const std::string& failure) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (place_.ended) return;
  place_.ended = true;
  place_.held = false;
  place_.failure = failure;
  changed_.notify_all();
}

}  // namespace monarch_flight
