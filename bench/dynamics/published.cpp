// Against the published histories of the FWUAV group (test/data/fwuav_*.csv): linear momentum,
// joint torques and wing pitch along them.
#include "dynamics/published.h"

#include "monarch_flight/wing/wing_pitch_solver.h"

namespace monarch_flight::verify {
namespace {

using Eigen::Vector3d;

constexpr double kBound = 1e-8;

/// Linear momentum in balance, with the published attitude where it turns forces of the body's
/// axes; the published equations have the mass itself in front of x''.
Vector3d momentumResidual(const MultibodyDynamics& dynamics, const Insect& insect,
                          const Sample& s) {
  InsectMotion m = s.motion(insect.beta);
  m.body.a.setZero();
  const Vector3d rest =
      dynamics.inertialForce(m).head<3>() - dynamics.appliedForce(m, s.loads).head<3>();
  return insect.totalMass() * (s.a - kGravity * Vector3d::UnitZ()) +
         s.R_IB * m.body.R_IB().transpose() * rest;
}

DynamicsRows alongHistory(const History& history, const std::string& folder) {
  const Insect insect = publishedInsect(history);
  const MultibodyDynamics dynamics(insect, kGravity);
  const WingPitchSolver hinge(Side::kRight, insect, kGravity, Newmark());
  const Rows rows(folder + "/" + history.file);
  double force = 0, force_scale = 0, torque = 0, torque_scale = 0, moment = 0, moment_scale = 0;
  double pitch = 0, pitch_scale = 0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const Sample s = sampleOf(history, rows, n);
    force = std::max(force, momentumResidual(dynamics, insect, s).norm());
    force_scale = std::max(force_scale, rows.vector(n, "f_a").norm());
    const InsectMotion m = s.motion(insect.beta);
    const Vector15d rest =
        dynamics.inertialForce(m) - dynamics.gravityForce(m) - dynamics.appliedForce(m, s.loads);
    Vector3d joints = Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      Vector3d own = rest.segment<3>(6 + 3 * static_cast<int>(i));
      if (i < 2) {
        const Wing& wing = insect.wings[kSides[i]];
        own.y() += wing.kappa * (s.angles.wings[kSides[i]].theta.q - wing.theta_0);
      }
      torque = std::max(torque, (m.joints[i].Q * own - s.torques[i]).norm());
      torque_scale = std::max(torque_scale, s.torques[i].norm());
      joints += s.torques[i];
    }
    moment = std::max(moment, publishedMomentRow(dynamics, insect, s).norm());
    moment_scale = std::max(moment_scale, joints.norm());
    if (!history.passive) continue;
    Loads loads;
    loads.force_pressure = s.loads[0].head<3>();
    loads.moment_pressure = s.loads[0].tail<3>();
    const double theta = rows(n, "X_dot_21");
    pitch = std::max(pitch, std::abs(hinge.acceleration(s.body, s.angles, loads) - theta));
    pitch_scale = std::max(pitch_scale, std::abs(theta));
  }
  const std::string of = std::string(" (") + history.name + ")";
  const std::string count = std::to_string(rows.size()) + " published rows";
  DynamicsRows result = {{"published", "linear momentum, residual / largest force" + of, count,
                          force, force_scale, force / force_scale, kBound},
                         {"published", "joint torques, difference / largest" + of, count, torque,
                          torque_scale, torque / torque_scale, kBound},
                         {"published", "body moment with their row, residual / largest" + of, count,
                          moment, moment_scale, moment / moment_scale, kBound}};
  if (history.passive) {
    result.push_back({"published", "wing pitch acceleration, difference / largest" + of, count,
                      pitch, pitch_scale, pitch / pitch_scale, kBound});
  }
  return result;
}

}  // namespace

DynamicsRows checkPublished(const DynamicsFolders& folders) {
  DynamicsRows rows = alongHistory(kHover, folders.data);
  for (const DynamicsRows& more : {alongHistory(kPassive, folders.data), checkAttitude(folders)}) {
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

}  // namespace monarch_flight::verify
