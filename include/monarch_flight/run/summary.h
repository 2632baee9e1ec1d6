#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "monarch_flight/run/case.h"
#include "monarch_flight/run/checkpoints.h"
#include "monarch_flight/run/mid_plane.h"
#include "monarch_flight/run/state_hash.h"

namespace monarch_flight {

/// Smallest, mean and largest of a quantity over the committed steps.
struct Range {
  double min = 0.0, max = 0.0, sum = 0.0;
  std::uint64_t count = 0;
  void add(double value);
  double mean() const { return count ? sum / static_cast<double>(count) : 0.0; }
};

/// What summary.json says of a run, gathered step by step.
///
/// Climb angle and speed: of the mean velocity from level 0 over all whole flaps flown
/// (displacement over time); over the whole run while less than a flap is flown or the motion has
/// no period. The angle is atan2(up, horizontal). Sub-iterations: of the solved steps; of all steps
/// where none was solved. Tumbled: a free pitch of the body was beyond 60 deg, first in this step;
/// its flap is counted from 1 at the start of the run.
class Summary {
 public:
  explicit Summary(const Case& c);
  void add(const CommittedStep& step);
  void onCheckpoint(StateVisitor& state) { memory(state); }
  /// Goes on from what onCheckpoint has shown.
  void resume(StateVisitor& state, const Resumption& resumption);
  /// The text of summary.json; `failure` is empty after a complete run.
  std::string json(const std::string& failure) const;

 private:
  void memory(StateVisitor& state);
  std::vector<std::string> remarks() const;
  Eigen::Vector3d meanVelocity() const;
  void addWork(const CommittedStep& step);
  void addTimes(const CommittedStep& step);
  double climbAngleDegrees() const;
  const Range& subIterations() const;
  std::uint64_t flapOf(std::uint32_t step) const;
  double flaps() const;
  double wallSeconds() const;

  static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

  Case case_;
  TimeGrid time_;
  std::uint32_t tumbled_ = kNever;  // step
  GuidanceReport guidance_;         // of the last step
  std::uint32_t lost_ = kNever;     // step at which the controller gave up
  std::chrono::steady_clock::time_point begin_;
  std::uint32_t steps_ = 0;
  std::uint64_t whole_flaps_ = 0;
  double t_first_ = 0.0, t_last_ = 0.0;  // of the mean velocity
  Eigen::Vector3d x_first_ = Eigen::Vector3d::Zero(), x_last_ = Eigen::Vector3d::Zero();
  Range theta_B_, roll_, theta_R_, theta_L_, solved_, all_, evaluations_, ratio_;
  std::uint32_t retried_ = 0;
  double work_fluid_ = 0.0, work_structure_ = 0.0, work_error_ = 0.0, work_scale_ = 0.0;
  std::array<double, kRoles> wall_{};
  double exchange_ = 0.0, coupling_ = 0.0, outputs_ = 0.0;
  KernelTimes kernels_{};
  double outputs_before_ = 0.0;  // of the parts flown before a resumption, as the next one
  KernelTimes kernels_before_{};
  long cells_ = 0;
  Matrix6d added_mass_ = Matrix6d::Zero();
  IgnoredMessages ignored_;
  MidPlane mid_plane_;
  StateHash hash_;
  double wall_before_ = 0.0;    // of the parts flown before a resumption [s]
  std::string resumed_ = "[]";  // JSON: where and how the run went on
};

}  // namespace monarch_flight
