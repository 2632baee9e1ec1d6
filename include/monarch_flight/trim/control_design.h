#pragma once
#include <complex>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/guidance/controller_settings.h"
#include "monarch_flight/trim/periodic_lqr.h"
#include "monarch_flight/trim/phase_map.h"

namespace monarch_flight {

/// What is asked of a controller's design (docs/guidance.md).
struct ControlOptions {
  int samples = 10;                                                           ///< of the law a flap
  std::vector<std::size_t> inputs{kAmplitudeCommand, kDeviationMeanCommand};  ///< of kCommandTable
  double time_constant = 0.06;                  ///< of the commands' filters [flaps]
  std::array<CommandLimits, kCommands> limits;  ///< rates a flap; must be given
  std::optional<double> speed, climb;  ///< set point [m/s], [rad]; default: the case's own motion
  std::vector<double> speeds, climbs;  ///< of the table [m/s], [rad]; empty: around the set point
  /// The reference at the set point is the case's own motion without commands instead of the
  /// periodic flight in quasi-steady air, and the table is moved with it: for flight in another
  /// air.
  bool own_orbit = false;
  /// The gains are those of that motion, too, instead of those of the periodic flight.
  bool own_gains = false;
  double state_weight = 0.3, integral_weight = 0.02, input_weight = 3.0;
  /// The limits of the program's defaults (config/defaults.yaml), with rates that suit a law.
  static std::array<CommandLimits, kCommands> usualLimits(const std::string& config_dir);
};

/// Periodic flight under constant commands.
struct ControlTrim {
  double speed = 0.0, climb = 0.0;  ///< [m/s], [rad]
  FlapState start = FlapState::Zero();
  WingbeatStart wingbeat;        ///< filters at rest at the commands
  std::vector<FlapState> orbit;  ///< at every sample
  double residual = 0.0;         ///< largest change over a flap, scaled
  Eigen::MatrixXd jacobian;      ///< of the search
};

struct ControlDesign {
  ControllerSettings settings;
  ControlOptions options;
  std::vector<LinearStage> stages;
  std::vector<std::complex<double>> open_loop, closed_loop;  ///< Floquet multipliers a flap
  double residual = 0.0;                                     ///< largest of the table's points
  int riccati_periods = 0;
};

/// The wingbeat that these options mean for a case.
WingbeatSettings wingbeatSettings(const Case& c, const ControlOptions& options);

/// The mean velocity of the case's own motion over a flap, as a set point.
SetPoint ownSetPoint(const Case& c);

/// A periodic flight with this mean velocity by constant commands, from a guess. Throws
/// NumericalError when there is none within the limits.
ControlTrim findTrim(const PhaseMap& map, const ControlOptions& options, double speed, double climb,
                     const ControlTrim& guess);

/// The maps between samples about an orbit, by central differences of whole flights: states x,
/// filters (value, rate, acceleration of each input), integrals; the inputs are the commands. Units
/// are those of ControllerSettings.
std::vector<LinearStage> linearise(const PhaseMap& map, const ControlOptions& options,
                                   const std::vector<FlapState>& orbit,
                                   const WingbeatStart& wingbeat);

/// Trims, table, gains of a case in quasi-steady air. Progress goes to `log`. Throws InputError and
/// NumericalError.
ControlDesign designController(const Case& c, const ControlOptions& options, std::ostream& log);

/// What a case needs for it: the text of its section `guidance`, with where the numbers come from.
std::string guidanceSection(const Case& c, const ControlDesign& design);

}  // namespace monarch_flight
