#pragma once
#include <complex>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/guidance/controller_settings.h"
#include "monarch_flight/trim/periodic_lqr.h"
#include "monarch_flight/trim/phase_map.h"

namespace monarch_flight {

struct ControlTrim;

/// What is asked of a controller's design (docs/guidance.md).
struct ControlOptions {
  int samples = 10;                                                           ///< of the law a flap
  std::vector<std::size_t> inputs{kAmplitudeCommand, kDeviationMeanCommand};  ///< of kCommandTable
  bool lateral_asked = false;  ///< there must be a lateral law
  /// Of the lateral law, where the wings are independent and y, roll and yaw free.
  std::vector<std::size_t> lateral_inputs{kDifferentialDeviation, kDifferentialRestAngle};
  double turn = M_PI / 36.0;                    ///< of the heading at most [rad a flap]
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
  /// Where the search begins: the trim of a like insect; nothing: the case's own motion.
  std::shared_ptr<const ControlTrim> guess;
  double state_weight = 0.3, integral_weight = 0.02, input_weight = 3.0;
  /// The limits of the program's defaults (config/defaults.yaml), with rates that suit a law.
  static std::array<CommandLimits, kCommands> usualLimits(const std::string& config_dir);
};

/// Periodic flight under constant commands; of an insect whose wings differ with those of the
/// lateral law, straight on and without side-slip.
struct ControlTrim {
  double speed = 0.0, climb = 0.0;  ///< [m/s], [rad]
  bool symmetric = true;            ///< the flight stays in the plane of symmetry by itself
  FlapState start = FlapState::Zero();
  WingbeatStart wingbeat;        ///< filters at rest at the commands
  std::vector<FlapState> orbit;  ///< at every sample
  std::vector<double> headings;  ///< the same, about their mean [rad]
  double residual = 0.0;         ///< largest change over a flap, scaled
  Eigen::MatrixXd jacobian;      ///< of the search
};

/// A law from linear maps about a periodic flight.
struct LinearLaw {
  std::vector<LinearStage> stages;
  FeedbackGains gains;
  std::vector<std::complex<double>> open_loop, closed_loop;  ///< Floquet multipliers a flap
  int riccati_periods = 0;
};

struct ControlDesign {
  ControllerSettings settings;
  ControlOptions options;
  LinearLaw in_plane;
  std::optional<LinearLaw> lateral;
  ControlTrim trim;       ///< at the set point
  double residual = 0.0;  ///< largest of the table's points
};

/// The wingbeat that these options mean for a case.
WingbeatSettings wingbeatSettings(const Case& c, const ControlOptions& options);

/// The mean velocity of the case's own motion over a flap, as a set point.
SetPoint ownSetPoint(const Case& c);

/// Whether a flight from the case's own motion stays in the plane of symmetry by itself.
bool fliesStraight(const PhaseMap& map);

/// A periodic flight with this mean velocity by constant commands, from a guess. Throws
/// NumericalError when there is none within the limits.
ControlTrim findTrim(const PhaseMap& map, const ControlOptions& options, double speed, double climb,
                     const ControlTrim& guess);

/// Trims, table, gains of a case in quasi-steady air. Progress goes to `log`. Throws InputError and
/// NumericalError.
ControlDesign designController(const Case& c, const ControlOptions& options, std::ostream& log);

/// What a case needs for it: the text of its section `guidance`, with where the numbers come from.
std::string guidanceSection(const Case& c, const ControlDesign& design);

}  // namespace monarch_flight
