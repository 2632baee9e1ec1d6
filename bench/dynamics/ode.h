#pragma once
// The equations of motion as ordinary differential equations, for integration by a method of high
// order: what the proofs of this folder need and the step-wise solvers (Newmark) cannot give.
#include <array>
#include <boost/numeric/odeint.hpp>
#include <functional>
#include <vector>

#include "monarch_flight/flight/flight_solver.h"
#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/wing/wing_pitch_solver.h"

namespace monarch_flight::verify {

using OdeState = std::vector<double>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Runge-Kutta-Fehlberg of order 8 with constant steps; `watch(y, t)` sees every step.
template <typename System, typename Watch>
void integrate(const System& system, OdeState& y, double t_begin, double t_end, int steps,
               const Watch& watch) {
  boost::numeric::odeint::runge_kutta_fehlberg78<OdeState> stepper;
  const double dt = (t_end - t_begin) / steps;
  watch(y, t_begin);
  for (int n = 0; n < steps; ++n) {
    stepper.do_step(system, y, t_begin + n * dt, dt);
    watch(y, t_begin + (n + 1) * dt);
  }
}

/// Free body in three dimensions, all joints prescribed; state: x, quaternion (w, x, y, z), v,
/// Omega.
class FreeInsect {
 public:
  using Joints = std::function<std::array<JointState, 3>(double t)>;
  using JointLoads = std::function<std::array<Vector6d, 3>(double t)>;
  FreeInsect(const Insect& insect, double gravity, Joints joints, JointLoads loads);

  static OdeState state(const BodyState& body);
  /// The motion at time t, accelerations of the body included.
  InsectMotion motion(const OdeState& y, double t) const;
  void operator()(const OdeState& y, OdeState& dydt, double t) const;
  const MultibodyDynamics& dynamics() const { return dynamics_; }

 private:
  MultibodyDynamics dynamics_;
  Joints joints_;
  JointLoads loads_;
};

/// Accelerations (x'', z'', theta_B'', theta_R'') of the coupled pair of the package's own solvers
/// of flight and wing, both wings doing the same: both are affine in the other's accelerations, so
/// two plus four evaluations and one linear equation give them exactly. `loads`: on either wing.
Eigen::Vector4d coupledAccelerations(const FlightSolver& flight, const WingPitchSolver& wing,
                                     const BodyState& body, JointAngles angles, const Loads& loads);

/// Longitudinal flight with passive wing pitch by the package's own solvers: x, z, theta_B,
/// theta_R free, the rest from a motion. State: x, z, theta_B, theta_R, their rates, and the work
/// done so far by the joints' actuators and by the air.
class LongitudinalFlight {
 public:
  using RightLoads = std::function<Loads(double t)>;
  LongitudinalFlight(const Insect& insect, double gravity,
                     std::shared_ptr<const PrescribedMotion> motion, RightLoads loads);

  /// As the motion has it at time t.
  OdeState state(double t) const;
  /// Body and angles for a state, accelerations included.
  PrescribedState motion(const OdeState& y, double t) const;
  void operator()(const OdeState& y, OdeState& dydt, double t) const;
  /// Kinetic energy, and that of gravity and both springs [J].
  double kineticEnergy(const OdeState& y, double t) const;
  double potentialEnergy(const OdeState& y, double t) const;
  const FlightSolver& flight() const { return flight_; }
  const WingPitchSolver& wing() const { return wing_; }

 private:
  Insect insect_;
  std::shared_ptr<const PrescribedMotion> motion_;
  RightLoads loads_;
  FlightSolver flight_;
  WingPitchSolver wing_;
};

/// Free in all four coordinates.
inline const FreeCoordinates kAllFree{kX, kZ, kPitch, kThetaR};
/// Air loads of the size of a monarch's at frequency f, smooth, not of any real wing.
Loads smoothLoads(double frequency, double t);

}  // namespace monarch_flight::verify
