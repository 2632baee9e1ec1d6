#pragma once
#include <algorithm>
#include <cmath>

#include "fluid/momentum.h"

namespace monarch_flight {

constexpr double kUpwindMin = 0.05;  ///< share of first-order upwind at small Courant numbers
constexpr double kUpwindMax = 0.30;  ///< and at Courant numbers above 2

/// What a face between two points adds to a A_d, before the division by the width of a point's
/// control volume: the point above it has -`above` for its lower neighbour, the point below it
/// `below` for its upper one. Central differences, of second order: they transport the flow.
struct CentralFace {
  double half_a, diffusion;
  explicit CentralFace(const MomentumStep& s) : half_a(0.5 * s.a), diffusion(s.a * s.nu) {}

  /// `velocity` convects through the face, `inv_dist` = 1 / distance of the two points.
  void operator()(double velocity, double inv_dist, double& above, double& below) const {
    const double mean = half_a * velocity, spread = diffusion * inv_dist;
    above = mean + spread;
    below = mean - spread;
  }
};

/// The same with a small share of upwind differences: for the implicit factors, which act on the
/// increments of a step alone, so that the share is of second order in space and time together.
struct FactorFace {
  double half_a, dt, diffusion;
  explicit FactorFace(const MomentumStep& s) : half_a(0.5 * s.a), dt(s.dt), diffusion(s.a * s.nu) {}

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

}  // namespace monarch_flight
