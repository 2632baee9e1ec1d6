// The step-wise scheme: its order through the package's coordinator, and motions known exactly.
#include <cmath>
#include <memory>

#include "dynamics/given_flap.h"
#include "dynamics/ode.h"
#include "dynamics/rows.h"
#include "monarch_flight/coupling/coordinator.h"
#include "monarch_flight/coupling/participants.h"
#include "monarch_flight/math/rotation.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight::verify {
namespace {

using Eigen::Vector3d;

/// (x, z, theta_B, theta_R) after one flap by the package's coordinator, flight and wing; `known`:
/// the motion's accelerations at the start satisfy the equations of motion.
Eigen::Vector4d coupledFlap(const Case& c, std::shared_ptr<const PrescribedMotion> motion,
                            bool known, int steps) {
  CoupledModel model{c.insect};
  model.free = kAllFree;
  model.newmark.dt = c.time.period / steps;
  model.gravity = c.gravity;
  model.steps = static_cast<std::uint32_t>(steps);
  model.release = known ? 0 : 1;
  CouplingSettings settings = c.coupling;
  settings.prescribed_steps = 0;
  settings.tolerance = 1e-13;
  settings.load_tolerance = 1e-9;
  const auto loads = [f = 1.0 / c.time.period](double t) { return smoothLoads(f, t); };
  FluidParticipant fluid(Side::kRight, model, std::make_unique<GivenLoads>(loads));
  FlightParticipant flight(model);
  WingParticipant wing(model);
  GuidanceParticipant guidance(model, std::make_unique<MotionGuidance>(std::move(motion)));
  LastStep sink;
  const StopFlag stop{false};
  FlyUntil control(stop);
  const auto outcome = Coordinator(model, settings, {&fluid, &flight, &wing, &guidance, nullptr}, 1)
                           .run({&sink}, control);
  if (!outcome.complete) throw std::runtime_error("coupled flap: " + outcome.failure);
  const Interface& end = sink.last.interface;
  return {end.body.x.x(), end.body.x.z(), end.body.pitch.q, end.theta.right.q};
}

/// Error after one flap for falling time steps, and the order between the last two.
void addOrder(const std::string& name, const Case& c,
              const std::shared_ptr<const PrescribedMotion>& motion, bool known,
              const Eigen::Vector4d& exact, DynamicsRows& rows) {
  constexpr int kSteps[] = {250, 500, 1000, 2000};
  double before = 0.0, order = 0.0, error = 0.0;
  for (int steps : kSteps) {
    error =
        (coupledFlap(c, motion, known, steps) - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff();
    order = std::log2(before / error);
    rows.push_back({"newmark", name + ": largest relative error after a flap",
                    std::to_string(steps) + " steps a flap", error, 0.0, error, kStated});
    before = error;
  }
  rows.push_back({"newmark", name + ": order", "1000 and 2000 steps a flap", order, 2.0,
                  std::abs(order - 2.0), 0.1});
}

/// The hinge alone: theta = theta_0 + A cos(sqrt(kappa / J_yy) t).
void addPendulum(const Case& c, DynamicsRows& rows) {
  const Wing& wing = c.insect.wings.right;
  const double rate = std::sqrt(wing.kappa / wing.plate.J(1, 1));
  const double period = 2.0 * M_PI / rate, amplitude = 0.4;
  double before = 0.0, order = 0.0;
  for (int steps : {250, 500, 1000}) {
    Newmark newmark;
    newmark.dt = period / steps;
    const WingPitchSolver solver(Side::kRight, c.insect, 0.0, newmark);
    JointAngles angles;
    Coordinate& theta = angles.wings.right.theta;
    theta = {wing.theta_0 + amplitude, 0.0, -rate * rate * amplitude};
    // The trapezoidal rule keeps the amplitude and turns by 2 atan(rate dt / 2) a step.
    const double turn = 2.0 * std::atan(0.5 * rate * newmark.dt);
    double worst = 0.0;
    for (int n = 1; n <= 10 * steps; ++n) {
      theta = solver.step(theta, BodyState(), angles, Loads());
      worst = std::max(worst, std::abs(theta.q - wing.theta_0 - amplitude * std::cos(n * turn)));
    }
    const double error = amplitude * std::abs(std::cos(10 * steps * turn - 0.25 * M_PI) -
                                              std::cos(0.25 * M_PI));  // phase error, exact scheme
    rows.push_back({"pendulum", "wing on its hinge, 10 periods, against the scheme's closed form",
                    std::to_string(steps) + " steps a period", worst, 0.0, worst / amplitude,
                    1e-9});
    order = std::log2(before / error);
    before = error;
  }
  rows.push_back({"pendulum", "order of the phase against the exact motion",
                  "500 and 1000 steps a period", order, 2.0, std::abs(order - 2.0), 0.01});
}

/// Free fall without rotation (the scheme is exact) and with it (mass centre on a parabola).
void addFreeFall(const Case& c, DynamicsRows& rows) {
  const JointAngles angles = [&] {
    JointAngles still = c.motion->at(0.01).angles;
    for (Side side : kSides) {
      WingAngles& wing = still.wings[side];
      for (Coordinate* q : {&wing.phi, &wing.psi, &wing.theta}) q->qd = q->qdd = 0.0;
    }
    still.theta_A.qd = still.theta_A.qdd = 0.0;
    return still;
  }();
  Newmark newmark;
  newmark.dt = 1e-4;
  const FlightSolver solver(c.insect, c.gravity, kAllFree, newmark);
  BodyState body;
  body.v = {1.3, 0.0, -0.562};
  body.a = {0.0, 0.0, c.gravity};
  body = withPitch(body, {0.3, 0.0, 0.0});
  constexpr int kSteps = 1000;
  for (int n = 0; n < kSteps; ++n) body = solver.step(body, body, body, angles, {});
  const double t = kSteps * newmark.dt;
  const Vector3d exact(1.3 * t, 0.0, -0.562 * t + 0.5 * c.gravity * t * t);
  const double error = (body.x - exact).norm() + std::abs(body.pitch.q - 0.3);
  rows.push_back({"free fall", "position and pitch after 0.1 s, wings still", "1000 steps, Newmark",
                  body.x.z(), exact.z(), error / exact.norm(), 1e-12});

  const auto joints = insectMotion(c.insect.beta, BodyState(), angles).joints;
  const FreeInsect insect(
      c.insect, c.gravity, [joints](double) { return joints; },
      [](double) {
        return std::array<Vector6d, 3>{Vector6d::Zero(), Vector6d::Zero(), Vector6d::Zero()};
      });
  BodyState start = withPitch(BodyState(), {0.3, 0.0, 0.0});
  start.v = {1.3, 0.1, -0.562};
  start.Omega_B = {0.0, 40.0, 0.0};
  OdeState y = FreeInsect::state(start);
  Vector3d r0, v0;
  double worst = 0.0, spin = 0.0;
  integrate(insect, y, 0.0, t, kSteps, [&](const OdeState& s, double at) {
    const InsectMotion m = insect.motion(s, at);
    const Vector3d r = insect.dynamics().massCentre(m);
    if (at == 0.0) {
      r0 = r;
      v0 = insect.dynamics().linearMomentum(m) / c.insect.totalMass();
    }
    const Vector3d parabola = r0 + at * v0 + Vector3d(0.0, 0.0, 0.5 * c.gravity * at * at);
    worst = std::max(worst, (r - parabola).norm());
    spin = std::max(spin, std::abs(m.body.Omega_B.y() - 40.0));
  });
  rows.push_back({"free fall", "mass centre against the parabola, turning at 40 rad/s",
                  "1000 steps, order 8", worst, 0.0, worst / exact.norm(), 1e-12});
  rows.push_back({"free fall", "rate of turn of the rigid insect", "1000 steps, order 8", spin,
                  40.0, spin / 40.0, 1e-12});
}

}  // namespace

DynamicsRows checkNewmark(const DynamicsFolders& folders) {
  const Case c = loadCase("climb_printed", {}, folders.config);
  const double f = 1.0 / c.time.period;
  const LongitudinalFlight flight(c.insect, c.gravity, c.motion,
                                  [f](double t) { return smoothLoads(f, t); });
  DynamicsRows rows;
  OdeState y = flight.state(0.0);
  const PrescribedState start = flight.motion(y, 0.0);
  const auto ignore = [](const OdeState&, double) {};
  integrate(flight, y, 0.0, c.time.period, 4000, ignore);
  const Eigen::Vector4d exact(y[0], y[1], y[2], y[3]);
  addOrder("accelerations known at the start", c,
           std::make_shared<ConsistentStart>(c.motion, start), true, exact, rows);
  addOrder("released from the prescribed motion", c, c.motion, false, exact, rows);
  return rows;
}

DynamicsRows checkExactMotions(const DynamicsFolders& folders) {
  DynamicsRows rows;
  addPendulum(loadCase("hinge", {}, folders.config), rows);
  addFreeFall(loadCase("climb_printed", {}, folders.config), rows);
  return rows;
}

}  // namespace monarch_flight::verify
