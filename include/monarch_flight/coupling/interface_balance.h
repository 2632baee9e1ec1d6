#pragma once
#include <optional>

#include "monarch_flight/coupling/model.h"
#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/prescribed_motion.h"

namespace monarch_flight {

/// Power of the air on the wings that are solved, as the two sides of the interface have it [W].
struct InterfacePower {
  double fluid = 0.0;      ///< loads along the wing's motion
  double structure = 0.0;  ///< generalised forces along the generalised velocities
};

/// What crosses the interface between air and insect, and what the air weighs there.
class InterfaceBalance {
 public:
  explicit InterfaceBalance(const CoupledModel& model);

  /// `prescribed`, `guess`: what the air was evaluated for; `answer`: what flight and wing made of
  /// its loads. A bare wing has no dynamics of its own: the structure's side is then the answered
  /// motion.
  InterfacePower power(const PrescribedState& prescribed, const Interface& guess,
                       const Interface& answer, const PerWing<Loads>& loads) const;

  /// Spectral radius of M_s^-1 M_a over the free coordinates, both wings taking part: M_s their
  /// structural inertia, M_a that of the air for the `added_mass` of each wing
  /// (FluidModel::addedMass).
  /// 0 where nothing is free.
  double addedMassRatio(const PrescribedState& prescribed, const Interface& interface,
                        const PerWing<Matrix6d>& added_mass) const;

 private:
  CoupledModel model_;
  std::optional<MultibodyDynamics> dynamics_;  // empty for a bare wing
};

}  // namespace monarch_flight
