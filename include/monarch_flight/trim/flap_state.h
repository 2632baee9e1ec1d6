#pragma once
#include "monarch_flight/insect/newmark.h"
#include "monarch_flight/insect/start_motion.h"
#include "monarch_flight/insect/state.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// What the equations of motion move, position and heading apart: first what stays in the plane of
/// symmetry, then what leaves it. Velocities in axes that turn with the heading (HeadingMotion);
/// theta_L is told as its mirror image.
inline constexpr int kFlapStates = 12, kInPlaneStates = 6;
using FlapState = Eigen::Matrix<double, kFlapStates, 1>;
inline constexpr const char* kStateNames[kFlapStates] = {
    "u", "w",    "theta_B",  "theta_B_dot", "theta_R", "theta_R_dot",
    "v", "roll", "roll_dot", "yaw_dot",     "theta_L", "theta_L_dot"};
inline constexpr const char* kStateUnits[kFlapStates] = {
    "m/s", "m/s", "rad", "rad/s", "rad", "rad/s", "m/s", "rad", "rad/s", "rad/s", "rad", "rad/s"};

/// Scale of each state: changes of it count alike.
FlapState trimScales();

/// Whether both wings do the same and the body only pitches.
bool inPlane(const FlapState& state);

FlapState flapState(const Interface& interface);
/// Its time derivative.
FlapState flapRates(const Interface& interface);

/// A start at this place with heading 0 in a state with these rates; what is not free follows the
/// motion below.
StartValues startOf(const FreeCoordinates& free, const Eigen::Vector3d& place,
                    const FlapState& state, const FlapState& rates);

}  // namespace monarch_flight
