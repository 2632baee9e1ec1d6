#pragma once
#include "monarch_flight/coupling/state_visitor.h"
#include "monarch_flight/insect/state.h"

namespace monarch_flight {

/// What a command may be and how fast it may change, in its own unit.
struct CommandLimits {
  double low = 0.0, high = 0.0;  ///< both zero: not to be commanded
  double rate = 0.0;             ///< largest rate of change [unit/s], > 0
};

/// Makes a command smooth: a critically damped filter of third order,
///   x''' = w^3 (u - x) - 3 w^2 x' - 3 w x'',  w = 1 / time_constant,
/// behind a target u that goes to the command at most at the rate. Integrated exactly over a step,
/// whatever its length. The filter's impulse response is positive and its integral 1, so x stays
/// between the commands given, |x'| stays below the rate, and x, x', x'' are continuous (C2).
class CommandFilter {
 public:
  /// `time_constant` > 0 [s], `rate` > 0 [unit/s].
  CommandFilter(double time_constant, double rate) : w_(1.0 / time_constant), rate_(rate) {}
  /// At rest at zero.
  void reset();
  /// Over `dt` [s] with this command.
  void advance(double command, double dt);
  const Coordinate& value() const { return x_; }
  double integral() const { return integral_; }  ///< of the value, since reset [unit s]
  /// Target, value and derivatives, integral: `name` stands in front.
  void memory(StateVisitor& state, const char* name);

 private:
  void ramp(double slope, double dt);

  double w_, rate_;
  double u_ = 0.0;  // target
  Coordinate x_;
  double integral_ = 0.0;
};

}  // namespace monarch_flight
