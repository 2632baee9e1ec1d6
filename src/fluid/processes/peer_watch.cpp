#include "fluid/processes/peer_watch.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <iostream>
#include <memory>
#include <sstream>

#include "fluid/processes/quiet_thread.h"

namespace monarch_flight::fluid::processes {
namespace {

constexpr int kTicks = 20;            // of the thread in one limit
constexpr double kLongestTick = 1.0;  // [s]

double tickOf(double limit_s) {
  return limit_s > 0.0 ? std::min(kLongestTick, limit_s / kTicks) : kLongestTick;
}

long ticksOf(double limit_s) { return static_cast<long>(std::ceil(limit_s / tickOf(limit_s))); }

bool waiting(std::uint64_t moves) { return moves % 2 == 1; }

/// One more, by the only thread that writes it.
void count(std::atomic<std::uint64_t>& number) {
  number.store(number.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

std::unique_ptr<PeerWatch> the_watch;
WatchSlot* own_slot = nullptr;  // of this process while it is watched

}  // namespace

void PeerWatch::begin(MPI_Comm comm) {
  the_watch = std::make_unique<PeerWatch>(comm);
  own_slot = &the_watch->board_.own();
}

void PeerWatch::end() {
  own_slot = nullptr;
  the_watch.reset();
}

void PeerWatch::limit(double seconds) {
  if (!the_watch) return;
  const std::lock_guard<std::mutex> lock(the_watch->lock_);
  the_watch->limit_s_ = seconds;
  the_watch->wake_.notify_one();
}

void PeerWatch::call(int times) {
  if (!the_watch) return;
  the_watch->times_ = times;
  count(own_slot->calls);
}

PeerWatch::PeerWatch(MPI_Comm comm) : board_(comm), seen_(static_cast<std::size_t>(board_.size())) {
  thread_ = quietThread([this] { watch(); });
}

PeerWatch::~PeerWatch() {
  {
    const std::lock_guard<std::mutex> lock(lock_);
    ended_ = true;
    wake_.notify_one();
  }
  thread_.join();
}

void PeerWatch::watch() {
  std::unique_lock<std::mutex> lock(lock_);
  while (!ended_) {
    const auto tick = std::chrono::duration<double>(tickOf(limit_s_));
    if (wake_.wait_for(lock, tick) == std::cv_status::no_timeout) continue;  // not a whole tick
    look();
    if (limit_s_ > 0.0 && tooLong()) giveUp();
  }
}

/// One tick: compares every slot with what was last seen of it.
void PeerWatch::look() {
  count(board_.own().beats);
  for (int i = 0; i < board_.size(); ++i) {
    const WatchSlot& slot = board_.at(i);
    Seen& seen = seen_[static_cast<std::size_t>(i)];
    const std::uint64_t beats = slot.beats.load(std::memory_order_acquire);
    const std::uint64_t moves = slot.moves.load(std::memory_order_acquire);
    seen.silent = beats == seen.beats ? seen.silent + 1 : 0;
    seen.still = moves == seen.moves ? seen.still + 1 : 0;
    seen.beats = beats;
    seen.moves = moves;
  }
}

/// The main thread waits in vain. For its next call it waits as long as process 0 lives.
bool PeerWatch::tooLong() const {
  const long limit = ticksOf(limit_s_);
  const Seen& own = seen_[static_cast<std::size_t>(board_.ownIndex())];
  if (!waiting(own.moves)) return false;
  if (board_.own().peer.load(std::memory_order_relaxed) != WatchSlot::kCall) {
    return own.still >= limit * times_;
  }
  for (int i = 0; i < board_.size(); ++i) {
    if (board_.at(i).rank == 0) return seen_[static_cast<std::size_t>(i)].silent >= limit;
  }
  return false;
}

PeerWatch::Culprit PeerWatch::culprit() const {
  const long enough = ticksOf(limit_s_) / 2;
  const auto longest = [&](const auto& ticks) {  // the slot with the most, if these are enough
    int worst = -1;
    long most = enough - 1;
    for (int i = 0; i < board_.size(); ++i) {
      const long now = i == board_.ownIndex() ? -1 : ticks(i);
      if (now > most) worst = i, most = now;
    }
    return worst;
  };
  const auto hangs = [&](int i, const char* how) {
    return Culprit{"process " + std::to_string(board_.at(i).rank) + ", which hangs: " + how,
                   board_.at(i).pid};
  };
  const auto seen = [&](int i) { return seen_[static_cast<std::size_t>(i)]; };
  int one = longest([&](int i) { return seen(i).silent; });
  if (one >= 0) return hangs(one, "it gives no sign of life");
  one = longest([&](int i) { return waiting(seen(i).moves) ? -1 : seen(i).still; });
  if (one >= 0) return hangs(one, "it runs, but did not come");
  const std::uint64_t calls = board_.own().calls.load(std::memory_order_relaxed);
  one = longest([&](int i) { return board_.at(i).calls < calls ? seen(i).still : -1; });
  if (one >= 0) return hangs(one, "it did not take up the call");
  const int peer = board_.own().peer.load(std::memory_order_relaxed);
  if (peer >= 0) return {"process " + std::to_string(peer) + ", which did not come"};
  return {"the others; none that hangs is on this machine"};
}

/// In one piece, so that no other process writes into it. MPI is the main thread's.
void PeerWatch::giveUp() const {
  const Culprit one = culprit();
  std::ostringstream text;
  text << "process " << board_.own().rank << " of the flow has waited in vain for " << one.text
       << " (limit of the wait " << limit_s_ * times_ << " s); all of them end\n";
  std::cerr << text.str() << std::flush;
  if (one.pid > 0) kill(one.pid, SIGKILL);
  _exit(1);
}

PeerWait::PeerWait(int peer) : slot_(own_slot) {
  if (slot_ == nullptr) return;
  slot_->peer.store(peer, std::memory_order_relaxed);
  count(slot_->moves);
}

PeerWait::~PeerWait() {
  if (slot_ != nullptr) count(slot_->moves);
}

}  // namespace monarch_flight::fluid::processes
