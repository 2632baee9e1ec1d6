#pragma once
#include <algorithm>
#include <cmath>

#include "fluid/momentum/momentum.h"

namespace monarch_flight::fluid::momentum {

constexpr double kUpwindMin = 0.02;  ///< share of first-order upwind at small Courant numbers
constexpr double kUpwindMax = 0.30;  ///< and at Courant numbers above 2

/// What a face between two points adds to a A_d in the implicit factors, before the division by the
/// width of a point's control volume: the point above it has -`above` for its lower neighbour, the
/// point below it `below` for its upper one. Central differences and a small share of upwind
/// ones: the factors act on the increments of a step alone, so that the share is of second order in
/// space and time together.
struct FaceStencil {
  double half_a, dt, diffusion;
  explicit FaceStencil(const MomentumStep& s)
      : half_a(0.5 * s.a), dt(s.dt), diffusion(s.a * s.nu) {}

  /// `velocity` convects through the face, `inv_dist` = 1 / distance of the two points.
  void operator()(double velocity, double inv_dist, double& above, double& below) const {
    const double speed = std::abs(velocity), courant = speed * (dt * inv_dist);
    const double upwind =
        std::min(kUpwindMax, std::max(kUpwindMin, kUpwindMin + 0.25 * (courant - 1.0)));
    const double mean = half_a * velocity;
    const double spread = half_a * upwind * speed + diffusion * inv_dist;
    above = mean + spread;
    below = mean - spread;
  }
};

}  // namespace monarch_flight::fluid::momentum
