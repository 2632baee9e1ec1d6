#pragma once
#include <array>
#include <optional>

#include "monarch_flight/coupling/model.h"
#include "monarch_flight/flight/flight_solver.h"
#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/math/eigen.h"
#include "monarch_flight/wing/wing_pitch_solver.h"

namespace monarch_flight {

/// Dimensionless; 0 where a coordinate is prescribed.
using CouplingVector = CoordinateVector;

/// Motion of a wing relative to the air: (v_W; omega_W) and (a_W; alpha_W).
struct AirMotion {
  Vector6d velocity, acceleration;
};

/// One step from level n to n+1 in the coordinator's unknowns: increments d, by which the
/// accelerations of the free coordinates displace level n+1, q = q(a = 0) + L d. With them the
/// coordinator's own copy of flight and wing, which predicts their answers without an exchange
/// (microseconds); what counts for convergence are the answers of the participants themselves.
class StepModel {
 public:
  /// `length_scale` makes displacements dimensionless [m].
  StepModel(const CoupledModel& model, double length_scale);

  /// Sets the step: the committed level n and what is prescribed at level n+1 = `step`.
  void begin(const Interface& committed, const PrescribedState& prescribed, std::uint32_t step);
  const PrescribedState& prescribed() const { return prescribed_; }
  const FreeCoordinates& free() const { return model_.free; }
  Sides sides() const { return model_.sides(); }
  /// Length or 1 over beta dt^2: d times it is an acceleration [m/s^2, rad/s^2].
  const CouplingVector& scales() const { return scales_; }

  CouplingVector increments(const Interface& interface) const;
  /// Level n+1 for these increments, by Newmark; what is not free follows the prescribed motion.
  Interface interface(const CouplingVector& increments) const;
  /// H(d) - d for these loads, H being the answer of flight and wing to the interface of d.
  CouplingVector residual(const CouplingVector& increments, const PerWing<Loads>& loads) const;
  /// What the loads see of the interface of d: the motion of a wing relative to the wind.
  AirMotion airMotion(Side side, const CouplingVector& increments) const;

 private:
  CoupledModel model_;
  std::uint32_t step_ = 0;
  CouplingVector scales_;
  FlightSolver flight_;
  PerWing<std::optional<WingPitchSolver>> wings_;  // empty when the pitch is prescribed
  Interface committed_;
  PrescribedState prescribed_;
};

}  // namespace monarch_flight
