#pragma once
#include <memory>
#include <optional>

#include "monarch_flight/insect/prescribed_motion.h"

namespace monarch_flight {

/// Explicit start of one coordinate: it follows q0 + qd0 s + qdd0 s^2/2, s = t - t_start.
struct StartValue {
  double q0 = 0.0;   ///< [m] or [rad]
  double qd0 = 0.0;  ///< [m/s] or [rad/s]
  double qdd0 = 0.0;  ///< [m/s^2] or [rad/s^2]
  Coordinate at(double elapsed) const {
    return {q0 + elapsed * (qd0 + 0.5 * qdd0 * elapsed), qd0 + qdd0 * elapsed, qdd0};
  }
};

/// Explicit start of a body that leaves its plane: it turns at a constant rate.
struct StartAttitude {
  Eigen::Matrix3d R_IB = Eigen::Matrix3d::Identity();
  Eigen::Vector3d Omega_B = Eigen::Vector3d::Zero();  ///< body axes [rad/s]
};

/// Which coordinates start explicitly; the others follow the motion below.
struct StartValues {
  std::optional<StartValue> x, y, z, pitch, theta_R;
  std::optional<StartAttitude> attitude;  ///< instead of `pitch`
};

/// A motion in which some coordinates leave from explicit initial values at a
/// constant acceleration, zero unless given. With
/// an explicit pitch the body only pitches (BodyState's invariant holds).
class StartMotion : public PrescribedMotion {
 public:
  StartMotion(std::shared_ptr<const PrescribedMotion> base, StartValues start, double t_start)
      : base_(std::move(base)), start_(start), t_start_(t_start) {}
  PrescribedState at(double t) const override;

 private:
  std::shared_ptr<const PrescribedMotion> base_;
  StartValues start_;
  double t_start_;
};

}  // namespace monarch_flight
