#include "monarch_flight/flight/flight_solver.h"

#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

constexpr int kBody = 6;  // coordinates of the body, the first ones of all

void requireBody(const Insect& insect, const FreeCoordinates& free) {
  if (insect.bare_wing && free.body()) {
    throw InputError(
        "free/x, y, z, roll, pitch, yaw: must be false for a bare wing, which has no body to move; "
        "set them to false or give an insect with a body");
  }
}

/// A bare wing never asks for the dynamics; its body stands in with no mass at all.
MultibodyDynamics dynamicsOf(Insect insect, double gravity, const FreeCoordinates& free) {
  requireBody(insect, free);
  insect.bare_wing = false;
  return MultibodyDynamics(insect, gravity);
}

Coordinate coordinate(const BodyState& body, int axis) {
  return {body.x(axis), body.v(axis), body.a(axis)};
}

void assign(BodyState& body, int axis, const Coordinate& value) {
  body.x(axis) = value.q;
  body.v(axis) = value.qd;
  body.a(axis) = value.qdd;
}

/// Newmark's increment and the new value of a velocity w with w' at n and at n+1.
Coordinate turned(const Newmark& newmark, double w, double w_dot, double w_dot_next) {
  return newmark.advance({0.0, w, w_dot}, w_dot_next);
}

/// Attitude and angular velocity of level n+1 on the group.
void turn(BodyState& next, const BodyState& n, const FreeCoordinates& free, const Newmark& newmark,
          const Eigen::Vector3d& Omega_dot) {
  Eigen::Vector3d increment;
  for (int i = 0; i < 3; ++i) {
    if (free[kRoll + static_cast<std::size_t>(i)]) {
      const Coordinate c = turned(newmark, n.Omega_B(i), n.Omega_dot_B(i), Omega_dot(i));
      increment(i) = c.q;
      next.Omega_B(i) = c.qd;
      next.Omega_dot_B(i) = c.qdd;
    } else {  // next is as prescribed
      increment(i) = 0.5 * newmark.dt * (n.Omega_B(i) + next.Omega_B(i));
    }
  }
  next.q_IB = (n.q_IB * expQuaternion(increment)).normalized();
  setPitchAngle(next);
}

}  // namespace

BodyState advancedBody(const BodyState& n, const BodyState& prescribed, const FreeCoordinates& free,
                       const Newmark& newmark, const BodyVector& accelerations) {
  BodyState next = prescribed;
  for (int i = 0; i < 3; ++i) {
    if (free[static_cast<std::size_t>(i)])
      assign(next, i, newmark.advance(coordinate(n, i), accelerations(i)));
  }
  const bool rolls_or_yaws = free[kRoll] || free[kYaw];
  if (!rolls_or_yaws && !free[kPitch]) return next;
  const bool in_plane = onlyPitches(n) && (!free[kRoll] || accelerations(kRoll) == 0.0) &&
                        (!free[kYaw] || accelerations(kYaw) == 0.0);
  if (free[kPitch] && (in_plane || !rolls_or_yaws))
    return withPitch(next, newmark.advance(n.pitch, accelerations(kPitch)));
  turn(next, n, free, newmark, accelerations.tail<3>());
  return next;
}

FlightSolver::FlightSolver(const Insect& insect, double gravity, const FreeCoordinates& free,
                           const Newmark& newmark)
    : beta_(insect.beta),
      dynamics_(dynamicsOf(insect, gravity, free)),
      free_(free),
      newmark_(newmark) {}

BodyVector FlightSolver::accelerations(const BodyState& guess, const JointAngles& angles,
                                       const PerWing<Loads>& loads) const {
  BodyVector known;
  known << guess.a, guess.Omega_dot_B;
  if (!free_.body()) return known;
  for (int i = 0; i < kBody; ++i) {
    if (free_[static_cast<std::size_t>(i)]) known(i) = 0.0;
  }
  InsectMotion motion = insectMotion(beta_, guess, angles);
  motion.body.a = known.head<3>();
  motion.body.Omega_dot_B = known.tail<3>();
  Eigen::Matrix<double, kBody, kBody> J = dynamics_.inertia(motion).topLeftCorner<kBody, kBody>();
  BodyVector force = (dynamics_.airForce(motion, loads) + dynamics_.gravityForce(motion) -
                      dynamics_.inertialForce(motion))
                         .head<kBody>();
  for (int i = 0; i < kBody; ++i) {
    if (free_[static_cast<std::size_t>(i)]) continue;
    J.row(i).setZero();
    J.col(i).setZero();
    J(i, i) = 1.0;
    force(i) = 0.0;
  }
  const Eigen::LLT<Eigen::Matrix<double, kBody, kBody>> factor(J);
  if (factor.info() != Eigen::Success) {
    throw NumericalError("the mass matrix of the free body coordinates is not positive definite");
  }
  return known + factor.solve(force);
}

BodyState FlightSolver::step(const BodyState& n, const BodyState& prescribed,
                             const BodyState& guess, const JointAngles& angles,
                             const PerWing<Loads>& loads) const {
  if (free_[kPitch] && !free_[kRoll] && !free_[kYaw] &&
      !(n.R_IB() - rotationY(n.pitch.q)).isZero(1e-9)) {
    throw InputError(
        "free/pitch = true: the body's attitude must be a pure pitch (no roll, no yaw); prescribe "
        "such a motion, set free/pitch to false, or free/roll and free/yaw to true");
  }
  return advancedBody(n, prescribed, free_, newmark_, accelerations(guess, angles, loads));
}

}  // namespace monarch_flight
