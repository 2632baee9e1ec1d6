#pragma once
#include <cstdint>
#include <memory>
#include <utility>

#include "monarch_flight/coupling/state_visitor.h"
#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/insect/wind_model.h"
#include "monarch_flight/insect/wingbeat.h"

namespace monarch_flight {

/// What guidance knows when it prescribes level n+1: all of the committed level n.
struct GuidanceInput {
  std::uint32_t step = 0;      ///< n+1
  double t = 0.0;              ///< of level n+1 [s]
  double dt = 0.0;             ///< from level n [s]
  Interface interface;         ///< of level n
  PerWing<Loads> loads;        ///< of level n
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

/// A motion that is a function of time, in a wind: nothing to remember.
class MotionGuidance : public Guidance {
 public:
  /// `frequency`: of the motion [Hz], for the phase in the report; 0: none.
  explicit MotionGuidance(std::shared_ptr<const PrescribedMotion> motion,
                          std::shared_ptr<const WindModel> wind = std::make_shared<SteadyWind>(),
                          double frequency = 0.0)
      : motion_(std::move(motion)), wind_(std::move(wind)), frequency_(frequency) {}
  PrescribedState start(double t) override;
  PrescribedState next(const GuidanceInput& input) override;
  GuidanceReport report() const override;

 private:
  std::shared_ptr<const PrescribedMotion> motion_;
  std::shared_ptr<const WindModel> wind_;
  double frequency_, t_ = 0.0;
};

/// The wind that the body meets at level n+1, its place there by extrapolation from level n.
Wind windAhead(const WindModel& wind, const GuidanceInput& input);

}  // namespace monarch_flight
