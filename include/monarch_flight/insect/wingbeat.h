#pragma once
#include <array>
#include <cstddef>
#include <optional>

namespace monarch_flight {

/// What can be commanded of the wingbeat, as a change of what the case's motion does; all zero: the
/// motion itself. Both wings do the same, but for the differences: the right wing gets them on top,
/// the left one less by as much.
struct WingbeatChange {
  double amplitude = 0.0;          ///< of flapping, relative: phi swings by (1 + amplitude) times
  double flapping_mean = 0.0;      ///< added to phi [rad]
  double frequency = 0.0;          ///< of the wingbeat, relative
  double deviation_mean = 0.0;     ///< added to psi [rad]
  double rest_angle = 0.0;         ///< added to the hinge's rest angle theta_0 [rad]
  double abdomen_mean = 0.0;       ///< added to theta_A [rad]
  double abdomen_amplitude = 0.0;  ///< of the abdomen, relative
  // Between the wings, for wings that are independent.
  double differential_amplitude = 0.0;   ///< of `amplitude`
  double differential_flapping = 0.0;    ///< of `flapping_mean` [rad]
  double differential_deviation = 0.0;   ///< of `deviation_mean` [rad]
  double differential_rest_angle = 0.0;  ///< of `rest_angle` [rad]
};

/// The commands one by one, for everything that goes through all of them: index in kCommandTable.
enum Command : std::size_t {
  kAmplitudeCommand,
  kFlappingMeanCommand,
  kFrequencyCommand,
  kDeviationMeanCommand,
  kRestAngleCommand,
  kAbdomenMeanCommand,
  kAbdomenAmplitudeCommand,
  kDifferentialAmplitude,
  kDifferentialFlapping,
  kDifferentialDeviation,
  kDifferentialRestAngle
};
inline constexpr std::size_t kCommands = 11;
/// The command that tells the wings apart in this one; nothing: they always do the same.
inline std::optional<Command> differenceOf(Command both) {
  switch (both) {
    case kAmplitudeCommand:
      return kDifferentialAmplitude;
    case kFlappingMeanCommand:
      return kDifferentialFlapping;
    case kDeviationMeanCommand:
      return kDifferentialDeviation;
    case kRestAngleCommand:
      return kDifferentialRestAngle;
    default:
      return std::nullopt;
  }
}
struct CommandInfo {
  const char* name;  ///< in case files, messages (`applied`, `command`) and tables
  const char* unit;  ///< "" when relative
  double WingbeatChange::*value;
};
inline constexpr std::array<CommandInfo, kCommands> kCommandTable = {
    {{"amplitude", "", &WingbeatChange::amplitude},
     {"flapping_mean", "rad", &WingbeatChange::flapping_mean},
     {"frequency", "", &WingbeatChange::frequency},
     {"deviation_mean", "rad", &WingbeatChange::deviation_mean},
     {"rest_angle", "rad", &WingbeatChange::rest_angle},
     {"abdomen_mean", "rad", &WingbeatChange::abdomen_mean},
     {"abdomen_amplitude", "", &WingbeatChange::abdomen_amplitude},
     {"differential_amplitude", "", &WingbeatChange::differential_amplitude},
     {"differential_flapping", "rad", &WingbeatChange::differential_flapping},
     {"differential_deviation", "rad", &WingbeatChange::differential_deviation},
     {"differential_rest_angle", "rad", &WingbeatChange::differential_rest_angle}}};

/// What guidance has done by a time level.
struct GuidanceReport {
  WingbeatChange command;  ///< taken, within the bounds: where the filters go to
  WingbeatChange applied;  ///< what the wings fly: the filters' values
  double phase = 0.0;      ///< flaps since t = 0, whole and part
  unsigned clipped = 0;    ///< commands cut to their bounds since the run began
  unsigned refused = 0;    ///< commands not taken at all, not being finite, since then
  bool lost = false;       ///< whoever leads has given up (docs/guidance.md)
};

}  // namespace monarch_flight
