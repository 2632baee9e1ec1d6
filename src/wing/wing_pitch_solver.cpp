#include "monarch_flight/wing/wing_pitch_solver.h"

#include <stdexcept>

namespace monarch_flight {

WingPitchSolver::WingPitchSolver(Side side, const Insect& insect, double gravity,
                                 const Newmark& newmark)
    : side_(side),
      insect_(insect),
      gravity_(gravity),
      newmark_(newmark),
      hinge_(insect.wings[side]) {
  if (!(wing().plate.J(1, 1) > 0.0)) {
    throw std::invalid_argument("the wing's moment of inertia J_yy must be positive");
  }
}

double WingPitchSolver::momentWithoutHinge(const BodyState& body, JointAngles angles,
                                           const Loads& loads) const {
  // Everything but J_yy theta'': the wing's motion with theta'' = 0.
  angles.wings[side_].theta.qdd = 0.0;
  const WingMotion motion = wingMotion(side_, insect_, body, angles);
  const Appendage& plate = wing().plate;
  const Eigen::Vector3d g_W = gravity_ * motion.R_IW.row(2).transpose();
  const Eigen::Vector3d moment = loads.moment() - plate.m * plate.nu.cross(motion.a_W - g_W) -
                                 plate.J * motion.alpha_W -
                                 motion.omega_W.cross(plate.J * motion.omega_W);
  return moment.y();
}

double WingPitchSolver::acceleration(const BodyState& body, const JointAngles& angles,
                                     const Loads& loads, double rest_angle) const {
  return hinge_.acceleration(wing().plate.J(1, 1), momentWithoutHinge(body, angles, loads),
                             angles.wings[side_].theta, rest_angle);
}

Coordinate WingPitchSolver::step(const Coordinate& n, const BodyState& body,
                                 const JointAngles& angles, const Loads& loads,
                                 double rest_angle) const {
  return hinge_.step(newmark_, n, wing().plate.J(1, 1), momentWithoutHinge(body, angles, loads),
                     rest_angle);
}

}  // namespace monarch_flight
