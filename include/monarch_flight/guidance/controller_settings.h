#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/guidance/feedback_law.h"
#include "monarch_flight/insect/wingbeat.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// What both wings do alike: the first commands of kCommandTable, inputs of the law in the plane of
/// symmetry; the others are those of the lateral law.
inline constexpr std::size_t kAlikeCommands = kDifferentialAmplitude;

/// What a controller feeds back in the plane of symmetry: velocity forward in the horizontal and
/// down, relative to the air [m/s], theta_B [rad], theta_B' [rad/s] and, where the wing pitches
/// passively, theta_R [rad], theta_R' [rad/s].
inline constexpr int kControlStates = 6;
using ControlState = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kControlStates, 1>;
inline constexpr int kLateralStates = 7;  ///< LateralState

/// A point of the trim table as a controller uses it at one phase.
struct TrimReference {
  ControlInput commands;     ///< that hold the periodic flight
  ControlState state;        ///< of the periodic flight at this phase
  ControlState next;         ///< one sample later
  Eigen::Vector2d velocity;  ///< mean from this sample to the next, x and z of NED [m/s]
};

/// Periodic flights over speed and climb angle, each by its commands and its states at every
/// sample. Between the points bilinear, beyond the edges the edge.
class TrimTable {
 public:
  TrimTable() = default;
  /// `speeds` [m/s] and `climbs` [rad, up] ascend. Row i * climbs.size() + k of `commands` belongs
  /// to speed i and climb k, so do the `samples` rows of `states` from row (that) * samples on.
  TrimTable(std::vector<double> speeds, std::vector<double> climbs, Eigen::MatrixXd commands,
            Eigen::MatrixXd states);
  /// At sample `phase` for the mean velocity x, z (NED) [m/s]: `reference` has its sizes already.
  void at(const Eigen::Vector2d& velocity, int phase, TrimReference& reference) const;

  const std::vector<double>& speeds() const { return speeds_; }
  const std::vector<double>& climbs() const { return climbs_; }
  const Eigen::MatrixXd& commands() const { return commands_; }
  const Eigen::MatrixXd& states() const { return states_; }
  int samples() const { return samples_; }

 private:
  std::vector<double> speeds_, climbs_;
  Eigen::MatrixXd commands_, states_;
  Eigen::MatrixXd means_;  // of the velocity over the samples of a point
  int samples_ = 0;
};

/// From this flap on the flight shall have this mean velocity over ground.
struct SetPoint {
  double flap = 0.0;   ///< on the phase clock
  double speed = 0.0;  ///< [m/s]
  double climb = 0.0;  ///< up from the horizontal [rad]
  /// Whole turns included [rad]; nothing: as before, at first that of the start.
  std::optional<double> heading = std::nullopt;
  Eigen::Vector2d velocity() const;  ///< x and z of NED [m/s]
};

/// Holds the heading of a flight with independent wings.
struct LateralSettings {
  FeedbackGains gains;  ///< integrals: of heading [rad flaps], of side velocity [m/s flaps]
  double turn = 0.0;    ///< of the heading at most [rad a flap]
  Eigen::VectorXd turn_commands;  ///< of a turn without side-slip, per rad a flap
  Eigen::MatrixXd turn_states;    ///< its states at every sample, a row each, per rad a flap
  /// The same of the flight straight on; all zero where both sides are alike.
  Eigen::VectorXd commands;
  Eigen::MatrixXd states;
};

/// A law for one insect, its motion and its filters (docs/guidance.md).
struct ControllerSettings {
  int samples = 0;             ///< N of the law a flap
  double time_constant = 0.0;  ///< of the commands' filters that the gains belong to [flaps]
  bool wing_pitch = true;      ///< theta_R and its rate are fed back
  TrimTable table;
  FeedbackGains gains;  ///< integrals: of the velocity forward and down [m/s flaps]
  std::optional<LateralSettings> lateral;  ///< nothing: heading, roll and side-slip are left alone
  std::vector<SetPoint> set_points;        ///< by flap; the first one holds from the start
  double slew = 0.0;                       ///< of the set point [m/s a flap]
  /// Lost: body pitch (or roll, with a lateral law) is further off its reference than this [rad],
  /// or an input has been limited for so many flaps on end.
  double lost_pitch = 0.0, lost_flaps = 0.0;
  std::uint32_t first_step = 0;  ///< until this level the flight is prescribed: trimmed commands

  int states() const { return wing_pitch ? 6 : 4; }
  int lateralStates() const { return wing_pitch ? kLateralStates : kLateralStates - 2; }
  /// Every fault at once, "guidance/controller/<key> ...: must be ...".
  std::vector<std::string> problems() const;
};

}  // namespace monarch_flight
