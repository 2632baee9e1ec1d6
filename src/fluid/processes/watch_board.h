#pragma once
#include <mpi.h>

#include <atomic>
#include <cstdint>

namespace monarch_flight::fluid::processes {

/// What one process of the flow shows of itself to those of the same machine. Only counts: none of
/// them reads another's clock.
struct alignas(64) WatchSlot {
  static constexpr int kEverybody = -1, kCall = -2;

  std::atomic<std::uint64_t> beats;  ///< of the thread that watches: the process runs
  std::atomic<std::uint64_t> moves;  ///< odd: within a wait, even: computing
  std::atomic<std::uint64_t> calls;  ///< of process 0 that were taken up
  std::atomic<int> peer;             ///< waited for: rank, kEverybody, or kCall: process 0's next
  int rank, pid;
};

/// The slots of all processes of one machine, in memory that they share.
class WatchBoard {
 public:
  /// Collective over `comm`. Where memory cannot be shared, each sees itself alone.
  explicit WatchBoard(MPI_Comm comm);
  ~WatchBoard();
  WatchBoard(const WatchBoard&) = delete;
  WatchBoard& operator=(const WatchBoard&) = delete;

  WatchSlot& own() const { return slots_[own_]; }
  int ownIndex() const { return own_; }
  const WatchSlot& at(int i) const { return slots_[i]; }
  int size() const { return size_; }

 private:
  WatchSlot* slots_ = nullptr;
  int size_ = 1, own_ = 0;
};

}  // namespace monarch_flight::fluid::processes
