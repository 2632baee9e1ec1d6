#include "monarch_flight/math/rotation.h"

#include <cmath>

namespace monarch_flight {

Eigen::Matrix3d hat(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return A;
}

Eigen::Vector3d vee(const Eigen::Matrix3d& A) { return {A(2, 1), A(0, 2), A(1, 0)}; }

Eigen::Matrix3d expSO3(const Eigen::Vector3d& a) {
  const double angle = a.norm();
  double sine_ratio = 1.0 - angle * angle / 6.0;   // sin(angle)/angle, exact to rounding below 1e-4
  double half_ratio = 1.0 - angle * angle / 24.0;  // sin(angle/2)/(angle/2)
  if (angle > 1e-4) {
    sine_ratio = std::sin(angle) / angle;
    half_ratio = std::sin(0.5 * angle) / (0.5 * angle);
  }
  const Eigen::Matrix3d A = hat(a);
  return Eigen::Matrix3d::Identity() + sine_ratio * A + 0.5 * half_ratio * half_ratio * A * A;
}

Quaternion expQuaternion(const Eigen::Vector3d& a) {
  const double angle = a.norm();
  double half_ratio =
      0.5 - angle * angle / 48.0;  // sin(angle/2)/angle, exact to rounding below 1e-4
  if (angle > 1e-4) half_ratio = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), half_ratio * a.x(), half_ratio * a.y(), half_ratio * a.z()};
}

Eigen::Matrix3d rotationOf(const Quaternion& q) { return q.toRotationMatrix(); }

Eigen::Vector3d logSO3(const Eigen::Matrix3d& R) {
  // The unit quaternion (cos, axis sin) of half the angle is well conditioned everywhere, pi
  // included.
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine == 0.0) return Eigen::Vector3d::Zero();
  return (2.0 * std::atan2(sine, q.w()) / sine) * q.vec();
}

Eigen::Matrix3d rotationX(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d R;
  R << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
  return R;
}

Eigen::Matrix3d rotationY(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d R;
  R << c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c;
  return R;
}

Eigen::Matrix3d rotationZ(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d R;
  R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return R;
}

Quaternion quaternionX(double angle) {
  return {std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0, 0.0};
}

Quaternion quaternionY(double angle) {
  return {std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0};
}

Quaternion quaternionZ(double angle) {
  return {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
}

Eigen::Matrix3d orthonormalised(const Eigen::Matrix3d& R) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

}  // namespace monarch_flight
