#pragma once
#include <memory>
#include <optional>

#include "monarch_flight/insect/prescribed_motion.h"

namespace monarch_flight {

/// Explicit start of one coordinate: it follows q0 + qd0 s + qdd0 s^2/2, s = t - t_start.
struct StartValue {
  double q0 = 0.0;    ///< [m] or [rad]
  double qd0 = 0.0;   ///< [m/s] or [rad/s]
  double qdd0 = 0.0;  ///< [m/s^2] or [rad/s^2]
  Coordinate at(double elapsed) const {
    return {q0 + elapsed * (qd0 + 0.5 * qdd0 * elapsed), qd0 + qdd0 * elapsed, qdd0};
  }
};

/// Returns `body` with attitude, Omega and Omega_dot of these z-y-x angles: yaw, then pitch, then
/// roll.
BodyState withAngles(BodyState body, const Coordinate& roll, const Coordinate& pitch,
                     const Coordinate& yaw);

/// Which coordinates start explicitly; the others follow the motion below.
struct StartValues {
  std::optional<StartValue> x, y, z, roll, pitch, yaw, theta_R;
  std::optional<StartValue> theta_L;  ///< nothing: as theta_R
};

/// A motion in which some coordinates leave from explicit initial values at a
/// constant acceleration, zero unless given. With
/// an explicit pitch the body only pitches (BodyState's invariant holds), unless
/// roll or yaw start explicitly, too: then the base must be a motion that only pitches.
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
