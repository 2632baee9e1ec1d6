#pragma once
#include <cstdint>

#include "monarch_flight/coupling/stop_flag.h"

namespace monarch_flight {

/// Who leads a run from outside: a signal, or a person with services. The coordinator asks before
/// every sub-iteration, so a run can be held between two steps and inside one.
class RunControl {
 public:
  enum class Order {
    kGoOn,
    kStop,       ///< end the run; the last committed step stays good
    kReset,      ///< back to level 0; everything flown so far is void
    kCheckpoint  ///< keep the last committed step, then ask again
  };
  virtual ~RunControl() = default;
  /// Steps before `step` are committed, `iteration` is the number of the sub-iteration that comes
  /// next. May wait as long as the leader likes; throws ExchangeError when a node is lost
  /// meanwhile.
  virtual Order next(std::uint32_t step, std::uint32_t iteration) = 0;
};

/// Flies on until a flag is set, as a signal handler sets it.
class FlyUntil : public RunControl {
 public:
  /// `stop` must outlive this.
  explicit FlyUntil(const StopFlag& stop) : stop_(stop) {}
  Order next(std::uint32_t, std::uint32_t) override { return stop_ ? Order::kStop : Order::kGoOn; }

 private:
  const StopFlag& stop_;
};

}  // namespace monarch_flight
