#pragma once
#include "monarch_flight/math/eigen.h"

namespace monarch_flight::fluid {

/// Of a velocity gradient g(c, d) = d v_c / d x_d: Q = (|rotation|^2 - |strain|^2) / 2 where the
/// flow is free of divergence [1/s^2], and the vorticity [1/s].
inline double secondInvariant(const Eigen::Matrix3d& gradient) {
  return -0.5 * (gradient * gradient).trace();
}

inline Eigen::Vector3d curl(const Eigen::Matrix3d& g) {
  return {g(2, 1) - g(1, 2), g(0, 2) - g(2, 0), g(1, 0) - g(0, 1)};
}

}  // namespace monarch_flight::fluid
