#pragma once
// Flight in all eight coordinates as an ordinary differential equation, with wings that do
// different things.
#include "dynamics/ode.h"

namespace monarch_flight::verify {

/// Six degrees of freedom and both wings' pitch by the package's own solvers of flight and wing,
/// the other joints from a motion. State: x, quaternion (w, x, y, z), v, Omega, theta and theta' of
/// the right wing, of the left wing.
class SixDofFlight {
 public:
  using WingLoads = std::function<PerWing<Loads>(double t)>;
  SixDofFlight(const Insect& insect, double gravity, std::shared_ptr<const PrescribedMotion> motion,
               WingLoads loads);

  static OdeState state(const PrescribedState& at);
  /// Body and angles for a state, accelerations included.
  PrescribedState motion(const OdeState& y, double t) const;
  void operator()(const OdeState& y, OdeState& dydt, double t) const;

 private:
  std::shared_ptr<const PrescribedMotion> motion_;
  WingLoads loads_;
  FlightSolver flight_;
  PerWing<WingPitchSolver> wings_;
};

/// Everything free.
inline const FreeCoordinates kAllEight{kX, kY, kZ, kRoll, kPitch, kYaw, kThetaR, kThetaL};

/// A motion whose left wing swings less, later and about another mean, of a body that starts with
/// roll, yaw, side-slip and a turn.
class AsymmetricMotion : public PrescribedMotion {
 public:
  AsymmetricMotion(std::shared_ptr<const PrescribedMotion> base, double period)
      : base_(std::move(base)), period_(period) {}
  PrescribedState at(double t) const override;

 private:
  std::shared_ptr<const PrescribedMotion> base_;
  double period_;
};

/// Different loads on both wings, smooth, of the size of a monarch's; the left ones in the mirror.
PerWing<Loads> asymmetricLoads(double frequency, double t);

}  // namespace monarch_flight::verify
