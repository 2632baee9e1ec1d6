#pragma once
#include "monarch_flight/insect/state.h"

namespace monarch_flight {

/// The body as seen in axes that turn with its heading: x forward in the horizontal, y to the
/// right, z down. Of a body that only pitches these are the inertial ones, pitch beyond 90 deg
/// included.
struct HeadingMotion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< over ground [m/s]
  /// Time derivative of these components, the axes' turning included [m/s^2].
  Eigen::Vector3d velocity_dot = Eigen::Vector3d::Zero();
  Coordinate roll, pitch, yaw;  ///< z-y-x angles, yaw first [rad]; at pitch +-90 deg without rates
};
HeadingMotion headingMotion(const BodyState& body);

/// Components of an inertial vector in axes turned by `yaw`.
Eigen::Vector3d inHeading(const Eigen::Vector3d& inertial, double yaw);

}  // namespace monarch_flight
