#pragma once
#include <atomic>

namespace monarch_flight {

/// Asks a run to end; set by another thread or by a signal handler, which only a lock-free flag
/// bears.
using StopFlag = std::atomic<bool>;
static_assert(StopFlag::is_always_lock_free, "a signal handler must not wait for a lock");

}  // namespace monarch_flight
