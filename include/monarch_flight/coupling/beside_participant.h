#pragma once
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "monarch_flight/coupling/participant.h"

namespace monarch_flight {

/// A participant of this process that works on a thread of its own between `ask` and `answer`, so
/// that another one can work at the same time. The thread sleeps otherwise.
class BesideParticipant : public Participant {
 public:
  explicit BesideParticipant(std::unique_ptr<Participant> inner);
  ~BesideParticipant() override;
  Reply exchange(const Request& request) override;
  void ask(const Request& request) override;
  Reply answer() override;
  IgnoredMessages ignored() const override { return inner_->ignored(); }

 private:
  void work();

  std::unique_ptr<Participant> inner_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool asked_ = false, over_ = false;  // work waits, or is being done; the end
  Request request_;
  Reply reply_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace monarch_flight
