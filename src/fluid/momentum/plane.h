#pragma once
#include "fluid/momentum/right_side.h"

namespace monarch_flight::fluid::momentum {

/// What one thread needs to solve the factors along x and y of a plane.
struct PlaneScratch {
  explicit PlaneScratch(const Layout& layout);
  Array x_sum, x_mobility, y_lower, y_upper;                         ///< kLines rows
  Array lane_sum, lane_mobility, lane_extra, lane_gamma, lane_side;  ///< the same, interleaved
  Array y_sum[2], y_above[2];                                        ///< rows of faces
  Array gamma_y;                                                     ///< all rows of a plane
};

/// The right sides of plane k of a component, then its factors along x and y solved, kLines rows at
/// a time while they are in the cache. `delta` is the component's whole field.
void solvePlane(const Metrics& m, const MomentumStep& step, const ExplicitSide& side, int component,
                int k, double* delta, PlaneScratch& scratch);

/// The right sides alone, of the normal component in the wing's plane.
void formWingPlane(const Metrics& m, const MomentumStep& step, const ExplicitSide& side,
                   double* delta, PlaneScratch& scratch);
/// The factors there, for a change of the wall's velocity, which the wing's faces take.
void solveWingPlane(const Metrics& m, const MomentumStep& step, const Velocity& c,
                    const WallVelocity& wall_change, double* delta, PlaneScratch& scratch);

}  // namespace monarch_flight::fluid::momentum
