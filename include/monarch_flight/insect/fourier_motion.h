#pragma once
#include <string>
#include <vector>

#include "monarch_flight/insect/prescribed_motion.h"

namespace monarch_flight {

/// In the unit of its coefficients, rad for angles and m for sway:
/// a0 + sum over n = 1, 2, ... of an[n-1] cos(n w t) + bn[n-1] sin(n w t), w = multiple * 2 pi f.
struct FourierSeries {
  double a0 = 0.0;         ///< mean
  std::vector<double> an;  ///< cosine coefficients
  std::vector<double> bn;  ///< sine coefficients
  int multiple = 1;        ///< the series runs at this multiple of the flapping frequency
  bool constant() const { return an.empty() && bn.empty(); }
  /// Value with exact first and second derivatives; `frequency` in Hz, t in s. Units are the
  /// coefficients' own (rad, or m for sway).
  Coordinate at(double frequency, double t) const;
};

/// Angles of body and joints as Fourier series; the body's mass centre at constant velocity, and
/// around that a periodic sway.
struct FourierMotionSettings {
  double frequency = 0.0;  ///< flapping frequency [Hz]; 0 only with constant angles
  FourierSeries phi, psi, theta, theta_A, pitch;       ///< [rad]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< at t = 0, F_I (NED) [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< F_I (NED) [m/s]
  FourierSeries sway_x, sway_z;  ///< added to the position along x and z of F_I, coefficients [m]
};

/// Motion by Fourier series, for every t.
class FourierMotion : public PrescribedMotion {
 public:
  explicit FourierMotion(FourierMotionSettings settings) : settings_(std::move(settings)) {}
  PrescribedState at(double t) const override;

 private:
  FourierMotionSettings settings_;
};

}  // namespace monarch_flight
