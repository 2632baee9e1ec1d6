#pragma once
#include <mpi.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "fluid/processes/watch_board.h"

namespace monarch_flight::fluid::processes {

/// Sees to it that no process of the flow waits for ever for another one that hangs. A thread of
/// each process counts how long the main thread has been in one wait (`PeerWait`); past the limit
/// it says which process did not come, ends that one if it is on this machine (mpirun may be gone
/// before it has ended one that is stopped) and its own with exit code 1, on which mpirun ends them
/// all. It never calls MPI, and time in which the whole process is stopped does not count.
class PeerWatch {
 public:
  /// Begins to watch; collective over `comm`. There is one watch in a program, until `end`.
  static void begin(MPI_Comm comm);
  static void end();
  /// The limit of one wait in the calls that follow [s]; 0, as at the start: none. Every process
  /// sets it for itself.
  static void limit(double seconds);
  /// Takes up the next call of process 0, in which a wait may take `times` that limit.
  static void call(int times);

  explicit PeerWatch(MPI_Comm comm);
  ~PeerWatch();
  PeerWatch(const PeerWatch&) = delete;
  PeerWatch& operator=(const PeerWatch&) = delete;

 private:
  /// What was last seen of a slot, and the ticks since then.
  struct Seen {
    std::uint64_t beats = 0, moves = 0;
    long silent = 0, still = 0;
  };

  void watch();
  void look();
  bool tooLong() const;
  [[noreturn]] void giveUp() const;
  /// The process that keeps this one waiting: how that shows, in words; its id if it is on this
  /// machine, else 0.
  struct Culprit {
    std::string text;
    int pid = 0;
  };
  Culprit culprit() const;

  WatchBoard board_;
  std::vector<Seen> seen_;  ///< of each slot, by the thread
  std::mutex lock_;
  std::condition_variable wake_;
  bool ended_ = false;
  double limit_s_ = 0.0;       ///< of a wait, 0: none
  std::atomic<int> times_{1};  ///< that limit, in the call at hand
  std::thread thread_;
};

/// A wait of this process for another one, for as long as the object lives. Costs a few stores.
class PeerWait {
 public:
  /// For a process by its rank, or one of the constants of WatchSlot.
  explicit PeerWait(int peer);
  ~PeerWait();
  PeerWait(const PeerWait&) = delete;
  PeerWait& operator=(const PeerWait&) = delete;

 private:
  WatchSlot* slot_;
};

}  // namespace monarch_flight::fluid::processes
