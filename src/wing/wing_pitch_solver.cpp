#include "monarch_flight/wing/wing_pitch_solver.h"

#include <stdexcept>

namespace monarch_flight {

WingPitchSolver::WingPitchSolver(const Insect& insect, double gravity, const Newmark& newmark)
    : insect_(insect), gravity_(gravity), newmark_(newmark) {
  if (!(insect.right.J(1, 1) > 0.0)) {
    throw std::invalid_argument("the wing's moment of inertia J_yy must be positive");
  }
}

double WingPitchSolver::momentWithoutSpring(const BodyState& body, JointAngles angles,
                                            const Loads& loads) const {
  // Everything but J_yy theta'': the wing's motion with theta'' = 0.
  angles.theta.qdd = 0.0;
  const WingMotion motion = rightWingMotion(insect_, body, angles);
  const Appendage& wing = insect_.right;
  const Eigen::Vector3d g_W = gravity_ * motion.R_IW.row(2).transpose();
  const Eigen::Vector3d moment = loads.moment() - wing.m * wing.nu.cross(motion.a_W - g_W) -
                                 wing.J * motion.alpha_W -
                                 motion.omega_W.cross(wing.J * motion.omega_W);
  return moment.y();
}

double WingPitchSolver::acceleration(const BodyState& body, const JointAngles& angles,
                                     const Loads& loads, double rest_angle) const {
  const double spring = -insect_.kappa * (angles.theta.q - (insect_.theta_0 + rest_angle));
  return (momentWithoutSpring(body, angles, loads) + spring) / insect_.right.J(1, 1);
}

Coordinate WingPitchSolver::step(const Coordinate& n, const BodyState& body,
                                 const JointAngles& angles, const Loads& loads,
                                 double rest_angle) const {
  const double unaccelerated = newmark_.advance(n, 0.0).q;
  const double spring = -insect_.kappa * (unaccelerated - (insect_.theta_0 + rest_angle));
  const double stiffness = insect_.kappa * newmark_.beta * newmark_.dt * newmark_.dt;
  return newmark_.advance(
      n, (momentWithoutSpring(body, angles, loads) + spring) / (insect_.right.J(1, 1) + stiffness));
}

}  // namespace monarch_flight
