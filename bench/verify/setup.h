#pragma once
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "fluid/flow/flow.h"
#include "monarch_flight/fluid/navier_stokes.h"
#include "monarch_flight/math/rotation.h"
#include "verify/report.h"

namespace monarch_flight::verify {

using namespace fluid;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Motion = std::function<WingMotion(double t)>;

constexpr double kNoCourantLimit = 1e3;

inline Air airOf(double rho, double mu) {
  Air air;
  air.rho = rho;
  air.mu = mu;
  return air;
}

inline std::string text(const char* format, double a, double b = 0, double c = 0) {
  char buffer[80];
  std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return buffer;
}

inline Axis uniformAxis(double low, double high, int n) {
  std::vector<double> f(n + 1);
  for (int i = 0; i <= n; ++i) f[i] = low + (high - low) * i / n;
  return Axis::fromFaces(f);
}

/// The layout of a level at another resolution in every direction.
inline GridSettings scaled(const char* level, double cells_per_chord) {
  GridSettings s = GridSettings::preset(level);
  const double finer = cells_per_chord / s.cells_per_chord;
  s.level = "custom";
  s.cells_per_chord = cells_per_chord;
  s.first_cell /= finer;
  s.growth_plane = s.growth_normal = 1 + (s.growth_plane - 1) / finer;
  return s;
}

/// The same in a box of another size, without a Courant limit.
inline GridSettings scaled(const char* level, double cells_per_chord, double far_field) {
  GridSettings s = scaled(level, cells_per_chord);
  s.far_field = far_field;
  s.courant_limit = kNoCourantLimit;
  return s;
}

/// 2 n uniform cells over [-core, core], then cells that grow by `ratio` out to `far` at least.
inline Axis coreAxis(double core, int n, double ratio, double far) {
  std::vector<double> up{0.0};
  for (int i = 1; i <= n; ++i) up.push_back(core * i / n);
  for (double w = core / n * ratio; up.back() < far; w *= ratio) up.push_back(up.back() + w);
  std::vector<double> f(up.rbegin(), up.rend() - 1);
  for (double& q : f) q = -q;
  f.insert(f.end(), up.begin(), up.end());
  return Axis::fromFaces(f);
}

/// Attitude, rates and accelerations of a wing that flaps by phi (about x), then pitches by theta
/// (about y): value, first and second derivative each; its root moves by `velocity` and
/// `acceleration`, inertial axes.
inline WingMotion flapAndPitch(const Vector3d& phi, const Vector3d& theta,
                               const Vector3d& velocity = Vector3d::Zero(),
                               const Vector3d& acceleration = Vector3d::Zero()) {
  const double s = std::sin(theta[0]), c = std::cos(theta[0]);
  WingMotion m;
  m.R_IW = rotationX(phi[0]) * rotationY(theta[0]);
  m.omega_W = Vector3d(phi[1] * c, theta[1], phi[1] * s);
  m.alpha_W =
      Vector3d(phi[2] * c - phi[1] * theta[1] * s, theta[2], phi[2] * s + phi[1] * theta[1] * c);
  m.v_W = m.R_IW.transpose() * velocity;
  m.a_W = m.R_IW.transpose() * acceleration;
  return m;
}

/// Amplitude * (sin, and its derivatives) of w t + phase.
inline Vector3d oscillation(double amplitude, double w, double t, double phase = 0) {
  const double s = std::sin(w * t + phase), c = std::cos(w * t + phase);
  return amplitude * Vector3d(s, w * c, -w * w * s);
}

/// Loads at every step of a run from t = 0.
inline std::vector<Loads> fly(FluidModel& flow, const Motion& motion, double dt, int steps) {
  std::vector<Loads> loads;
  flow.start(motion(0), dt);
  for (int n = 1; n <= steps; ++n) {
    loads.push_back(flow.evaluate(motion(n * dt)));
    flow.commit();
  }
  return loads;
}

/// Root of the mean square of the fourth difference / 16 over that of the values: the share of
/// step-to-step alternation.
inline double alternation(const std::vector<double>& f, std::size_t begin) {
  double rms = 0, noise = 0;
  for (std::size_t i = begin; i + 4 < f.size(); ++i) {
    const double d4 = (f[i] - 4 * f[i + 1] + 6 * f[i + 2] - 4 * f[i + 3] + f[i + 4]) / 16;
    rms += f[i] * f[i];
    noise += d4 * d4;
  }
  return std::sqrt(noise / rms);
}

/// Richardson's extrapolation from three values at spacings h[0] > h[1] > h[2].
struct Extrapolated {
  double order;  ///< observed, NaN when the values do not converge monotonically
  double value;  ///< with the observed order within [0.5, 2.5], or the nearer of the two; without
                 ///< one, 1
};
Extrapolated extrapolate(const double h[3], const double f[3]);

}  // namespace monarch_flight::verify
