#include "dynamics/published.h"

namespace monarch_flight::verify {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Insect publishedInsect(const History& history) {
  Insect insect{history.name,
                false,
                0,
                Matrix3d::Zero(),
                0,
                0,
                0,
                0,
                {},
                {},
                {},
                0,
                0,
                0,
                Planform::rectangle(0.0209048, 0.060997, 0.25)};
  insect.m_B = 1.485e-4;
  insect.J_B = Vector3d(5.988708e-10, 2.9481420375e-09, 2.9481420375e-09).asDiagonal();
  insect.right.m = 2.51e-05;
  insect.right.nu = {-0.004437781694645591, 0.015176339407718576, 0.0};
  insect.right.J << 2.756824953134474e-08, 2.4957003913366034e-09, 0.0, 2.4957003913366034e-09,
      2.579907487057571e-09, 0.0, 0.0, 0.0, 3.0148157018402314e-08;
  insect.right.mu = {0.0, 0.00284, 0.0};
  insect.left = mirrored(insect.right);
  insect.abdomen.m = 1.092e-4;
  insect.abdomen.nu = {-0.00869, 0.0, 0.0};
  insect.abdomen.J =
      Vector3d(1.87879965e-10, 1.1089084142499997e-08, 1.1089084142499997e-08).asDiagonal();
  insect.abdomen.mu = {-0.007315, 0.0, 0.0};
  insect.beta = history.beta;
  insect.kappa = history.kappa;
  insect.theta_0 = history.theta_0;
  return insect;
}

namespace {

/// Joint angles with phi'' and psi'' recovered from the published derivative of Omega_R.
JointAngles jointAngles(const Vector3d& euler, const Vector3d& euler_dot, const Vector3d& rate_dot,
                        const Coordinate& theta_A) {
  JointAngles angles{{euler.x(), euler_dot.x(), 0.0},
                     {euler.z(), euler_dot.z(), 0.0},
                     {euler.y(), euler_dot.y(), 0.0},
                     theta_A};
  const Vector3d rest = rate_dot - wingRateDerivative(angles);  // linear in second derivatives
  const double ct = std::cos(angles.theta.q), st = std::sin(angles.theta.q);
  angles.phi.qdd = (rest.x() * ct + rest.z() * st) / std::cos(angles.psi.q);
  angles.psi.qdd = rest.x() * st - rest.z() * ct;
  angles.theta.qdd = rest.y() - angles.phi.qdd * std::sin(angles.psi.q);
  return angles;
}

}  // namespace

Sample sampleOf(const History& history, const Rows& rows, std::size_t n) {
  Sample s;
  const bool p = history.passive;
  const int first = p ? 4 : 1;
  for (int j = 0; j < 3; ++j) {
    s.body.R_IB.row(j) = rows.vector(n, p ? "X" : "Rcm", first + 3 * j);
  }
  s.body.R_IB.transposeInPlace();  // published column by column
  s.body.v = p ? rows.vector(n, "X", 13) : rows.vector(n, "xdot");
  s.body.a = p ? rows.vector(n, "X_dot", 13) : rows.vector(n, "xddot");
  s.body.Omega_B = p ? rows.vector(n, "X", 16) : rows.vector(n, "W");
  s.body.Omega_dot_B = p ? rows.vector(n, "X_dot", 16) : rows.vector(n, "Wdot");
  const std::string bar = p ? "_" : "";
  s.right = jointAngles(
      rows.vector(n, "Euler" + bar + "R"), rows.vector(n, "Euler" + bar + "R" + bar + "dot"),
      rows.vector(n, "W_R" + bar + "dot"),
      {rows(n, p ? "theta_A" : "thetaA"), rows(n, "W_A_2"), rows(n, p ? "W_A_dot_2" : "W_Adot_2")});
  s.left = s.right;
  if (p) s.left.theta = {rows(n, "X_20"), rows(n, "X_22"), rows(n, "X_dot_22")};
  s.loads[0] << rows.vector(n, "F_R"), rows.vector(n, "M_R");
  s.loads[1] << rows.vector(n, "F_L"), rows.vector(n, "M_L");
  s.loads[2].setZero();
  for (int i = 0; i < 3; ++i)
    s.torques[static_cast<std::size_t>(i)] = rows.vector(n, "tau", 1 + 3 * i);
  return s;
}

Vector3d publishedMomentRow(const MultibodyDynamics& dynamics, const Insect& insect,
                            const Sample& s) {
  const InsectMotion m = s.motion(insect.beta);
  Vector3d row = (dynamics.inertialForce(m) - dynamics.gravityForce(m)).segment<3>(3);
  const Vector3d mus[] = {insect.right.mu, insect.left.mu, insect.abdomen.mu};
  for (std::size_t i = 0; i < 3; ++i) {
    row -= mus[i].cross(m.joints[i].Q * s.loads[i].head<3>()) - s.torques[i];
  }
  return row;
}

}  // namespace monarch_flight::verify
