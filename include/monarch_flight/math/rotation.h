#pragma once
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// Plain layout, without the padding that Eigen's own alignment would bring.
using Quaternion = Eigen::Quaternion<double, Eigen::DontAlign>;

/// Skew matrix with hat(a) b = a x b.
Eigen::Matrix3d hat(const Eigen::Vector3d& a);
/// Inverse of hat.
Eigen::Vector3d vee(const Eigen::Matrix3d& A);
/// Rotation by |a| about a/|a| (Rodrigues), accurate to rounding for every |a|, 0 included.
Eigen::Matrix3d expSO3(const Eigen::Vector3d& a);
/// Unit quaternion of expSO3(a): (cos, a/|a| sin) of |a|/2, accurate to rounding for every |a|.
Quaternion expQuaternion(const Eigen::Vector3d& a);
/// Rotation matrix of a unit quaternion. Compiled once, so that equal bits give equal bits
/// everywhere.
Eigen::Matrix3d rotationOf(const Quaternion& q);
/// Rotation vector of R with |log| <= pi; accurate near 0 and near pi.
Eigen::Vector3d logSO3(const Eigen::Matrix3d& R);
/// exp(angle e_i^), i = 1, 2, 3.
Eigen::Matrix3d rotationX(double angle);
Eigen::Matrix3d rotationY(double angle);
Eigen::Matrix3d rotationZ(double angle);
/// Their unit quaternions, exactly zero about the other axes.
Quaternion quaternionX(double angle);
Quaternion quaternionY(double angle);
Quaternion quaternionZ(double angle);
/// Closest rotation matrix (removes drift after many products).
Eigen::Matrix3d orthonormalised(const Eigen::Matrix3d& R);

}  // namespace monarch_flight
