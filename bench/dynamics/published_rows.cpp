#include "dynamics/published.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight::verify {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Insect publishedInsect(const History& history) {
  Appendage plate;
  plate.m = 2.51e-05;
  plate.nu = {-0.004437781694645591, 0.015176339407718576, 0.0};
  plate.J << 2.756824953134474e-08, 2.4957003913366034e-09, 0.0, 2.4957003913366034e-09,
      2.579907487057571e-09, 0.0, 0.0, 0.0, 3.0148157018402314e-08;
  plate.mu = {0.0, 0.00284, 0.0};
  const Wing wing{
      plate, Planform::rectangle(0.0209048, 0.060997, 0.25), history.kappa, history.theta_0, {}};
  Insect insect{history.name, false,        0,           Matrix3d::Zero(), 0, 0, 0, 0,
                {},           history.beta, {wing, wing}};
  insect.m_B = 1.485e-4;
  insect.J_B = Vector3d(5.988708e-10, 2.9481420375e-09, 2.9481420375e-09).asDiagonal();
  insect.abdomen.m = 1.092e-4;
  insect.abdomen.nu = {-0.00869, 0.0, 0.0};
  insect.abdomen.J =
      Vector3d(1.87879965e-10, 1.1089084142499997e-08, 1.1089084142499997e-08).asDiagonal();
  insect.abdomen.mu = {-0.007315, 0.0, 0.0};
  return insect;
}

namespace {

/// Angles of the right wing with phi'' and psi'' recovered from the published derivative of
/// Omega_R.
WingAngles wingAngles(const Vector3d& euler, const Vector3d& euler_dot, const Vector3d& rate_dot) {
  WingAngles angles{{euler.x(), euler_dot.x(), 0.0},
                    {euler.z(), euler_dot.z(), 0.0},
                    {euler.y(), euler_dot.y(), 0.0}};
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
    s.R_IB.col(j) = rows.vector(n, p ? "X" : "Rcm", first + 3 * j);
  }
  const Matrix3d nearest = orthonormalised(s.R_IB), turn = nearest * s.R_IB.transpose();
  const Vector3d g = kGravity * Vector3d::UnitZ();
  s.body.q_IB = nearest;
  s.body.v = turn * (p ? rows.vector(n, "X", 13) : rows.vector(n, "xdot"));
  s.a = p ? rows.vector(n, "X_dot", 13) : rows.vector(n, "xddot");
  s.body.a = g + turn * (s.a - g);
  s.body.Omega_B = p ? rows.vector(n, "X", 16) : rows.vector(n, "W");
  s.body.Omega_dot_B = p ? rows.vector(n, "X_dot", 16) : rows.vector(n, "Wdot");
  const std::string bar = p ? "_" : "";
  const WingAngles wing = wingAngles(rows.vector(n, "Euler" + bar + "R"),
                                     rows.vector(n, "Euler" + bar + "R" + bar + "dot"),
                                     rows.vector(n, "W_R" + bar + "dot"));
  s.angles = {
      {wing, wing},
      {rows(n, p ? "theta_A" : "thetaA"), rows(n, "W_A_2"), rows(n, p ? "W_A_dot_2" : "W_Adot_2")}};
  if (p) s.angles.wings.left.theta = {rows(n, "X_20"), rows(n, "X_22"), rows(n, "X_dot_22")};
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
  const Vector3d mus[] = {insect.wings.right.plate.mu, mirrored(insect.wings.left.plate).mu,
                          insect.abdomen.mu};
  for (std::size_t i = 0; i < 3; ++i) {
    row -= mus[i].cross(m.joints[i].Q * s.loads[i].head<3>()) - s.torques[i];
  }
  return row;
}

}  // namespace monarch_flight::verify
