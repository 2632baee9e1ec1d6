#pragma once
#include <cstdint>
#include <memory>
#include <utility>

#include "monarch_flight/coupling/state_visitor.h"
#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/insect/wingbeat.h"

namespace monarch_flight {

/// What guidance knows when it prescribes level n+1: all of the committed level n.
struct GuidanceInput {
  std::uint32_t step = 0;      ///< n+1
  double t = 0.0;              ///< of level n+1 [s]
  Interface interface;         ///< of level n
  Loads loads;                 ///< of level n, right wing
  PrescribedState prescribed;  ///< of level n
};

/// Owns the motion of a run: everything that is prescribed, level by level. Asked once a step,
/// before the first sub-iteration.
class Guidance {
 public:
  virtual ~Guidance() = default;
  /// Level 0, at t [s]; forgets everything that was.
  virtual PrescribedState start(double t) = 0;
  /// Level n+1. May change what `memory` shows.
  virtual PrescribedState next(const GuidanceInput& input) = 0;
  /// Of the level prescribed last.
  virtual GuidanceReport report() const { return {}; }
  /// What one step leaves to the next; numbers only.
  virtual void memory(StateVisitor&) {}
};

/// A motion that is a function of time, in a steady uniform wind: nothing to remember.
class MotionGuidance : public Guidance {
 public:
  explicit MotionGuidance(std::shared_ptr<const PrescribedMotion> motion,
                          const Eigen::Vector3d& wind_I = Eigen::Vector3d::Zero())
      : motion_(std::move(motion)), wind_I_(wind_I) {}
  PrescribedState start(double t) override { return at(t); }
  PrescribedState next(const GuidanceInput& input) override { return at(input.t); }

 private:
  PrescribedState at(double t) const {
    PrescribedState state = motion_->at(t);
    state.wind.v = wind_I_;
    return state;
  }
  std::shared_ptr<const PrescribedMotion> motion_;
  Eigen::Vector3d wind_I_;
};

}  // namespace monarch_flight
