#pragma once
#include "monarch_flight/guidance/command_source.h"
#include "monarch_flight/guidance/controller_settings.h"
#include "monarch_flight/guidance/feedback_law.h"
#include "monarch_flight/guidance/lateral_control.h"

namespace monarch_flight {

/// Keeps a butterfly in the air (docs/guidance.md). N times a flap, on the phase clock:
///   u = u_trim(r) - K (x - x_trim(r)) - K_c (c - c_trim(r)) - K_i z,
/// x the committed state with velocities relative to the air, c the filters of the commands, z the
/// integral over flaps of the mean velocity's distance from r, all gains those of the sample. r is
/// the set point over ground less the wind's mean over a flap, moved at most at the slew.
///  - z stops where an input has been limited and would be driven further (anti-windup).
///  - During the prescribed start: u_trim(r).
///  - Velocities are those forward in the horizontal and down. With independent wings a lateral law
///    (LateralControl) holds the heading of the set point with commands of its own.
///  - Lost (pitch too far off, not finite, too long limited): u_trim(r) from then on, for good.
/// No allocation behind the constructor.
class FlightController : public CommandSource {
 public:
  /// Throws InputError with every fault of the settings.
  explicit FlightController(ControllerSettings settings);
  void start() override;
  std::optional<WingbeatChange> next(const WingbeatLevel& level) override;
  bool lost() const override { return lost_; }
  void memory(StateVisitor& state) override;

  /// The set point through the air that is being followed, forward and down [m/s].
  const Eigen::Vector2d& reference() const { return reference_velocity_; }
  const Eigen::Vector2d& integral() const { return law_.integral(); }  ///< z [m/s flaps]
  const LateralControl* lateral() const { return lateral_ ? &*lateral_ : nullptr; }

 private:
  struct Air {
    Eigen::Vector2d velocity, wind;  // forward in the horizontal and down [m/s]
    double side_velocity;            // to the right [m/s]
  };
  static Air air(const GuidanceInput& level, const HeadingMotion& body);
  void average(const HeadingMotion& body, const Air& now);
  void sample(const WingbeatLevel& level, const Air& now, double index);
  void moveReference(double flap, double flaps);
  void feedBack(const WingbeatLevel& level, const Air& now, int phase);
  bool limited(const WingbeatChange& taken);
  std::optional<double> heading(double flap) const;

  ControllerSettings settings_;
  bool begun_;                               // there has been a sample
  double index_;                             // of the last one, samples since t = 0
  Eigen::Vector2d last_velocity_;            // through the air, level before
  Eigen::Vector2d velocity_sum_, wind_sum_;  // over the levels since the last sample
  double levels_;                            // of them
  Eigen::Vector2d wind_mean_;                // over about a flap
  Eigen::Vector2d reference_velocity_;       // r
  Eigen::Vector2d orbit_velocity_;           // that the periodic flight has from the last sample on
  FeedbackLaw law_;
  std::optional<LateralControl> lateral_;
  double limited_flaps_;  // on end
  bool lost_;
  TrimReference now_;  // of the sample; a function of the above
  ControlState deviation_;
};

}  // namespace monarch_flight
