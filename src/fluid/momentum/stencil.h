#pragma once
#include <algorithm>
#include <cmath>

#include "fluid/momentum/pack.h"

namespace monarch_flight::fluid::momentum {

/// Constants of one momentum step.
struct MomentumStep {
  double a;           ///< dt (first step) or 2 dt / 3: the factor of the new level's right side [s]
  double dt;          ///< [s]
  double nu;          ///< kinematic viscosity [m^2/s]
  double rho;         ///< [kg/m^3]
  bool second_order;  ///< BDF2; false: implicit Euler
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
