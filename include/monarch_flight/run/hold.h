#pragma once
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <string>

#include "monarch_flight/coupling/run_control.h"

namespace monarch_flight {

/// Where a run is.
struct RunPlace {
  std::uint32_t step = 0;       ///< the last committed one
  std::uint32_t iteration = 0;  ///< sub-iterations done of the next one
  bool held = false;            ///< it waits to be let go
  bool ended = false;
  std::string failure;  ///< of a run that has ended; empty: complete
  /// "held after step 12, sub-iteration 1 of step 13", for messages to people.
  std::string describe() const;
};

/// Holds a run and lets it go: what people ask for, from any thread, meets the coordinator's thread
/// in next(). A request returns when the coordinator has obeyed it, when the run has ended, or when
/// another request has overtaken it; the place says which. Steps always end, by the watchdogs of
/// the exchanges, so nobody waits for ever.
class Hold {
 public:
  explicit Hold(bool held) : held_(held) {}

  RunPlace place() const;
  /// Whether somebody wants what next() does: a hold, a reset, a checkpoint.
  bool wanted() const;
  /// Holds the run between two sub-iterations.
  RunPlace pause();
  /// The same without waiting for it.
  void pauseSoon();
  RunPlace resume();
  /// Flies on until `step` is committed, then holds; does not wait for that. Step 2^32-1: never.
  void flyUntil(std::uint32_t step);
  /// Flies `count` steps of a held run; changes nothing while the run flies (place.held is false
  /// and place.ended, too).
  RunPlace steps(std::uint32_t count);
  /// One sub-iteration of a held run; the same otherwise.
  RunPlace subIterate();
  /// Keeps the last committed step, held or not, and overtakes nobody; returns the place that was
  /// kept, or where the run has ended.
  RunPlace checkpoint();
  /// Back to level 0; a held run is held there.
  RunPlace reset();

  /// The coordinator's end (RunControl::next). `idle` is called again and again while the run is
  /// held, and should wait a moment.
  RunControl::Order next(std::uint32_t step, std::uint32_t iteration, const StopFlag& stop,
                         const std::function<void(const RunPlace&)>& idle);
  /// A step is committed; the place is behind it even if next() is never asked again.
  void committed(std::uint32_t step);
  /// The run is over; only the first call counts.
  void end(const std::string& failure);

 private:
  static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();
  template <class Done>
  RunPlace await(std::unique_lock<std::mutex>& lock, Done done);
  RunPlace letGo(std::uint32_t count, bool once);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  RunPlace place_;
  bool held_;                                        // wanted; place_.held: so it is
  bool once_ = false;                                // let go for one sub-iteration
  std::uint32_t hold_behind_ = kNever;               // step
  bool reset_ = false, resetting_ = false;           // wanted; under way
  bool checkpoint_ = false, checkpointing_ = false;  // the same
  RunPlace kept_;                                    // of the last checkpoint asked for
  std::uint64_t resets_ = 0, checkpoints_ = 0, requests_ = 0;
};

}  // namespace monarch_flight
