#pragma once
#include <array>
#include <chrono>
#include <cstddef>

namespace monarch_flight {

/// The parts of a step of the flow solver that are timed (docs/performance.md).
enum class Kernel : std::size_t {
  kTurning,      ///< both old levels into the predicted axes, the convecting field, Courant number
  kMomentumXY,   ///< right side, x and y factors
  kMomentumZ,    ///< z factor, sum; wall and outer faces of the result
  kOutflow,      ///< right side of the pressure system
  kTransforms,   ///< modes of x and y, both ways
  kColumns,      ///< elimination and substitution in z
  kCapacitance,  ///< the wing's answer to the jump
  kLoads,        ///< pressure, friction and rim; the sum over processes
  kProjection,   ///< gradient, pressure, neighbouring planes
  kCount
};
constexpr std::size_t kKernels = static_cast<std::size_t>(Kernel::kCount);
constexpr const char* kKernelNames[kKernels] = {"turning",     "momentum_x_y", "momentum_z",
                                                "net_outflow", "transforms",   "columns",
                                                "capacitance", "loads",        "projection"};

/// Wall time of each kernel [s].
using KernelTimes = std::array<double, kKernels>;

/// Adds the time since it was made, or since the last lap, to a kernel. A lap costs one reading of
/// the clock, some ten nanoseconds.
class LapTimer {
 public:
  explicit LapTimer(KernelTimes& times) : times_(times), last_(Clock::now()) {}
  void lap(Kernel kernel) {
    const Clock::time_point now = Clock::now();
    times_[static_cast<std::size_t>(kernel)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

  /// What passed since then is nobody's here.
  void restart() { last_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  KernelTimes& times_;
  Clock::time_point last_;
};

}  // namespace monarch_flight
