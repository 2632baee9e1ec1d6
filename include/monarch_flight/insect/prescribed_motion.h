#pragma once
#include <memory>
#include <string>

#include "monarch_flight/insect/state.h"

namespace monarch_flight {

/// State of everything at one time as the motion description has it.
struct PrescribedState {
  BodyState body;
  JointAngles angles;
};

/// Motion as a function of time, with consistent first and second derivatives. Immutable, thread-safe.
/// Concrete: FourierMotion, TableMotion (fourier_motion.h, table_motion.h).
class PrescribedMotion {
 public:
  virtual ~PrescribedMotion() = default;
  /// t in s; throws std::out_of_range (naming the bounds) where a table does not reach.
  virtual PrescribedState at(double t) const = 0;
};

}  // namespace monarch_flight
