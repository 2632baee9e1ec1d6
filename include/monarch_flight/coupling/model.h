#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "monarch_flight/insect/insect.h"
#include "monarch_flight/insect/newmark.h"
#include "monarch_flight/insect/state.h"

namespace monarch_flight {

/// Constant model that the solvers and the coordinator share. Built as
/// `CoupledModel model{insect}` and then filled; all of them keep a copy. It holds no motion: what
/// is prescribed comes with every request, from guidance (guidance.h).
struct CoupledModel {
  Insect insect;
  /// The air of the right wing is solved, the left wing is its mirror image; else that of both.
  bool mirrored = true;
  FreeCoordinates free = {};
  Newmark newmark = {};     ///< with the time step of the whole run
  double gravity = 9.81;    ///< along +z of NED [m/s^2]
  double t_start = 0.0;     ///< time of step 0 [s]
  std::uint32_t steps = 0;  ///< of the whole run
  /// First free step, which a released insect flies at constant acceleration: what the prescribed
  /// motion did before does not belong to its flight. 0: the motion's accelerations do.
  std::uint32_t release = 0;

  /// Wings whose air is solved.
  Sides sides() const { return {mirrored ? 1U : 2U}; }
  double time(std::uint32_t step) const { return t_start + step * newmark.dt; }
  /// Level n as Newmark leaves it for `step`, level n+1: in the release step with the accelerations
  /// of `next`, an error of second order that is made once; else as committed.
  Interface departure(std::uint32_t step, Interface committed, const Interface& next) const;
  /// Every fault at once (no time step, a bare wing with a free body, ...).
  std::vector<std::string> problems() const;
};

}  // namespace monarch_flight
