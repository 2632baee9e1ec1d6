#include "monarch_flight/flight/flight_solver.h"

#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

/// Rows of x'', z'' and theta_B'' = Omega_y' in the 15 velocities.
constexpr Eigen::Index kRows[3] = {0, 2, 4};

using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

void requireBody(const Insect& insect, const FreeCoordinates& free) {
  if (insect.bare_wing && (free.x || free.z || free.pitch)) {
    throw InputError(
        "free/x, free/z, free/pitch: must be false for a bare wing, which has no body to move; "
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

}  // namespace

BodyState advancedBody(const BodyState& n, const BodyState& prescribed, const FreeCoordinates& free,
                       const Newmark& newmark, const Eigen::Vector3d& accelerations) {
  BodyState next = prescribed;
  if (free.x) assign(next, 0, newmark.advance(coordinate(n, 0), accelerations(0)));
  if (free.z) assign(next, 2, newmark.advance(coordinate(n, 2), accelerations(1)));
  if (free.pitch) next = withPitch(next, newmark.advance(n.pitch, accelerations(2)));
  return next;
}

FlightSolver::FlightSolver(const Insect& insect, double gravity, const FreeCoordinates& free,
                           const Newmark& newmark)
    : beta_(insect.beta),
      dynamics_(dynamicsOf(insect, gravity, free)),
      free_(free),
      newmark_(newmark) {}

Eigen::Vector3d FlightSolver::accelerations(const BodyState& guess, const JointAngles& angles,
                                            const Loads& loads) const {
  Eigen::Vector3d result(guess.a.x(), guess.a.z(), guess.pitch.qdd);
  const std::array<bool, 3> is_free = {free_.x, free_.z, free_.pitch};
  std::array<int, 3> chosen{};
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    if (is_free[i]) chosen[count++] = i;
  }
  if (count == 0) return result;

  InsectMotion motion = insectMotion(beta_, guess, angles);
  if (free_.x) motion.body.a.x() = 0.0;
  if (free_.z) motion.body.a.z() = 0.0;
  if (free_.pitch) motion.body.Omega_dot_B.y() = 0.0;
  const Matrix15d J = dynamics_.inertia(motion);
  const Vector15d force = dynamics_.airForce(motion, loads) + dynamics_.gravityForce(motion) -
                          dynamics_.inertialForce(motion);
  SmallMatrix J_free(count, count);
  SmallVector force_free(count);
  for (int i = 0; i < count; ++i) {
    force_free(i) = force(kRows[chosen[i]]);
    for (int j = 0; j < count; ++j) J_free(i, j) = J(kRows[chosen[i]], kRows[chosen[j]]);
  }
  const Eigen::LLT<SmallMatrix> factor(J_free);
  if (factor.info() != Eigen::Success) {
    throw NumericalError("the mass matrix of the free body coordinates is not positive definite");
  }
  const SmallVector solution = factor.solve(force_free);
  for (int i = 0; i < count; ++i) result(chosen[i]) = solution(i);
  return result;
}

BodyState FlightSolver::step(const BodyState& n, const BodyState& prescribed,
                             const BodyState& guess, const JointAngles& angles,
                             const Loads& loads) const {
  if (free_.pitch && !(n.R_IB - rotationY(n.pitch.q)).isZero(1e-9)) {
    throw InputError(
        "free/pitch = true: the body's attitude must be a pure pitch (no roll, no yaw); prescribe "
        "such a motion or set free/pitch to false");
  }
  return advancedBody(n, prescribed, free_, newmark_, accelerations(guess, angles, loads));
}

}  // namespace monarch_flight
