#pragma once
#include <algorithm>
#include <cmath>

#include "fluid/momentum/pack.h"

namespace monarch_flight::fluid::momentum {

/// Constants of one momentum step: BDF2, v^(n+1) - v^n = memory (v^n - v^(n-1)) + a f^(n+1).
struct MomentumStep {
  double dt = 0;      ///< its length [s]
  double ratio = 0;   ///< by that of the step before; 0: there was none, implicit Euler
  double nu = 0;      ///< kinematic viscosity [m^2/s]
  double rho = 0;     ///< [kg/m^3]
  double memory = 0;  ///< 1/3 after a step of the same length
  double a = 0;       ///< 2 dt / 3 then [s]

  MomentumStep() = default;
  MomentumStep(double length, double length_before, double viscosity, double density)
      : dt(length),
        ratio(length_before > 0 ? length / length_before : 0),
        nu(viscosity),
        rho(density),
        memory(ratio * ratio / (1 + 2 * ratio)),
        a(dt * (1 + ratio) / (1 + 2 * ratio)) {}
};

constexpr double kUpwindMin = 0.02;  ///< share of first-order upwind at small Courant numbers
constexpr double kUpwindMax = 0.30;  ///< and at Courant numbers above 2

inline double absolute(double x) { return std::abs(x); }
inline double smaller(double a, double b) { return std::min(a, b); }
inline double larger(double a, double b) { return std::max(a, b); }

/// What a face between two points adds to a A_d in the implicit factors, before the division by the
/// width of a point's control volume: the point above it has -`above` for its lower neighbour, the
/// point below it `below` for its upper one. Central differences and a small share of upwind
/// ones: the factors act on the increments of a step alone, so that the share is of second order in
/// space and time together.
struct FaceStencil {
  double quarter_a, half_dt, diffusion;
  explicit FaceStencil(const MomentumStep& s)
      : quarter_a(0.25 * s.a), half_dt(0.5 * s.dt), diffusion(s.a * s.nu) {}

  /// `sum` is twice the velocity that convects through the face, `inv_dist` = 1 / distance of the
  /// two points. T: a double or a pack of them.
  template <class T>
  void operator()(T sum, double inv_dist, T& above, T& below) const {
    const T speed = absolute(sum);
    const T steep = (0.25 * half_dt * inv_dist) * speed + (kUpwindMin - 0.25);
    const T upwind = smaller(T{} + kUpwindMax, larger(T{} + kUpwindMin, steep));
    const T mean = quarter_a * sum;
    const T spread = quarter_a * upwind * speed + diffusion * inv_dist;
    above = mean + spread;
    below = mean - spread;
  }
};

}  // namespace monarch_flight::fluid::momentum
