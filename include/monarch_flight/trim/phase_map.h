#pragma once
#include <array>
#include <string>
#include <vector>

#include "monarch_flight/coupling/guidance.h"
#include "monarch_flight/guidance/wingbeat_guidance.h"
#include "monarch_flight/math/eigen.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/trim/flap_map.h"

namespace monarch_flight {

/// The wingbeat's filters and the commands that stand before them.
struct WingbeatStart {
  std::array<Coordinate, kCommands> filters{};
  WingbeatChange command;
};

/// What a flight does out of the plane of symmetry.
struct SideMotion {
  double turn = 0.0;           ///< heading at the end against that at the start [rad]
  double mean_heading = 0.0;   ///< against that at the start [rad]
  double mean_velocity = 0.0;  ///< to the right of the heading [m/s]
};

/// A flight from one phase of the flap to another.
struct PhaseFlight {
  bool complete = false;
  std::string failure;
  std::vector<FlapState> states;  ///< at every sample, the start first
  std::vector<FlapState> rates;   ///< their time derivatives
  std::vector<double> headings;   ///< at every sample, against the start's [rad]
  WingbeatStart wingbeat;         ///< at the end
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< mean, x and z of NED [m/s]
  SideMotion sideways;
};

/// Free flight of a case whose motion is periodic, in air without memory, from a state at a phase
/// of the flap under constant commands.
class PhaseMap {
 public:
  /// `samples` a flap, a divisor of the steps a flap; `time_constant` of the filters [s]. Throws
  /// InputError when the case cannot be flown so.
  PhaseMap(const Case& c, int samples, double time_constant);
  const Case& baseCase() const { return case_; }
  int samples() const { return samples_; }
  double timeConstant() const { return time_constant_; }
  /// From sample `phase` over `intervals` samples, in still air; `rates` of the state at the start
  /// (none: the first step at constant acceleration). What is prescribed is the case's.
  /// Thread-safe.
  PhaseFlight fly(int phase, const FlapState& state, const WingbeatStart& wingbeat, int intervals,
                  const FlapState* rates = nullptr) const;
  /// Time derivative of the state at a sample.
  FlapState ratesAt(int phase, const FlapState& state, const WingbeatStart& wingbeat) const;
  /// The case's own motion at a sample.
  FlapState prescribedState(int phase) const;
  double timeOf(int phase) const { return phase * case_.time.period / samples_; }

 private:
  RunResult flyFrom(int phase, const FlapState& state, const WingbeatStart& wingbeat,
                    std::uint32_t steps, const FlapState* rates, StepSink& sink) const;

  Case case_;
  int samples_;
  double time_constant_;
};

}  // namespace monarch_flight
