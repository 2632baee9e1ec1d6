#include "monarch_flight/coupling/beside_participant.h"

namespace monarch_flight {

BesideParticipant::BesideParticipant(std::unique_ptr<Participant> inner)
    : inner_(std::move(inner)), thread_([this] { work(); }) {}

BesideParticipant::~BesideParticipant() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

Reply BesideParticipant::exchange(const Request& request) {
  ask(request);
  return answer();
}

void BesideParticipant::ask(const Request& request) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return !asked_; });  // what nobody wants to hear any more
  request_ = request;
  failure_ = nullptr;
  asked_ = true;
  changed_.notify_all();
}

Reply BesideParticipant::answer() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return !asked_; });
  if (failure_) std::rethrow_exception(failure_);
  return std::move(reply_);
}

void BesideParticipant::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return over_ || asked_; });
    if (over_) return;
    lock.unlock();  // while `asked_`, request and reply belong to this thread
    try {
      reply_ = inner_->exchange(request_);
    } catch (...) {
      failure_ = std::current_exception();
    }
    lock.lock();
    asked_ = false;
    changed_.notify_all();
  }
}

}  // namespace monarch_flight
