#pragma once
#include <string>

#include "monarch_flight/insect/insect.h"

namespace monarch_flight {

/// Names of the joints in the URDF and in /joint_states: q is phi, psi, theta of the wings and
/// theta_A.
namespace joints {
constexpr char kRightFlap[] = "right_flap";
constexpr char kRightDeviation[] = "right_deviation";
constexpr char kRightPitch[] = "right_pitch";
constexpr char kLeftFlap[] = "left_flap";
constexpr char kLeftDeviation[] = "left_deviation";
constexpr char kLeftPitch[] = "left_pitch";
constexpr char kAbdomen[] = "abdomen_joint";
}  // namespace joints

/// Plain URDF of the insect. Root link base_link; all other links end in "_link", so that their tf
/// frames (robot_state_publisher) are never those that the coordinator publishes: right_wing_link
/// coincides with right_wing, and so on. Meshes are `mesh_uri` + right_wing.stl, left_wing.stl,
/// thorax.stl, abdomen.stl.
std::string insectUrdf(const Insect& insect, const std::string& mesh_uri);

/// Writes the meshes of insectUrdf into `directory` (made if missing). Throws InputError when a
/// file cannot be written.
void writeMeshes(const Insect& insect, const std::string& directory);

}  // namespace monarch_flight
