#pragma once
#include "monarch_flight/guidance/controller_settings.h"
#include "monarch_flight/guidance/feedback_law.h"
#include "monarch_flight/insect/heading.h"

namespace monarch_flight {

/// What the lateral law feeds back: side velocity relative to the air [m/s], roll, its rate,
/// heading less the reference, its rate [rad, rad/s] and, where the wings pitch passively, half of
/// theta_R - theta_L and its rate.
using LateralState = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kLateralStates, 1>;

/// The half of FlightController that leaves the plane of symmetry: holds a heading, and turns to
/// another one at a bounded rate with the commands and the bank of a turn without side-slip.
class LateralControl {
 public:
  LateralControl(const LateralSettings& settings, int samples, bool wing_pitch);
  void start();
  /// Every committed level: the body and its side velocity relative to the air.
  void average(const HeadingMotion& now, double side_velocity);
  /// Whether a command of the last sample was cut.
  bool limited(const WingbeatChange& taken) { return law_.limited(taken); }
  /// Once a sample, `flaps` after the last one (0: the first): integrals (while `active`) and the
  /// reference on its way (the same) to the heading `wanted` (nothing: the one of the start).
  void move(int phase, double flaps, std::optional<double> wanted, bool active);
  /// Commands of the reference, with feedback or without it.
  void refer();
  /// False: too far off its reference, or not a number.
  bool feedBack(int phase, const Interface& at, double lost_roll,
                const std::array<Coordinate, kCommands>& applied);
  void write(WingbeatChange& change) const { law_.write(change); }
  void memory(StateVisitor& state);

  double heading() const { return heading_; }      ///< whole turns included [rad]
  double reference() const { return reference_; }  ///< the same, that is being followed [rad]
  double turnRate() const { return turn_rate_; }   ///< of the reference [rad a flap]

 private:
  double stateOf(Eigen::Index phase, Eigen::Index state) const;
  void steer(double wanted);

  LateralSettings settings_;
  int samples_;
  bool wing_pitch_;
  FeedbackLaw law_;
  bool begun_;
  HeadingMotion now_;
  double side_velocity_;  // of the last level
  double heading_, reference_, turn_rate_;
  double origin_;                           // heading of the start
  double heading_sum_, side_sum_, levels_;  // since the last sample
  ControlInput commands_;
  LateralState deviation_;
};

}  // namespace monarch_flight
