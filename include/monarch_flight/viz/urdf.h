#pragma once
#include <std_msgs/ColorRGBA.h>

#include <string>

#include "monarch_flight/insect/insect.h"
#include "monarch_flight/viz/mesh.h"

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

/// Plain URDF of the insect. Its links are the frames that the coordinator publishes, from
/// base_link on; a robot_state_publisher would give the same ones from the joint states. Meshes are
/// `mesh_uri` + right_wing.stl, left_wing.stl, thorax.stl, abdomen.stl.
std::string insectUrdf(const Insect& insect, const std::string& mesh_uri);

/// Body and abdomen as ellipsoids, the latter in its own frame.
Mesh thoraxMesh(const Insect& insect);
Mesh abdomenMesh(const Insect& insect);
std_msgs::ColorRGBA wingColour();
std_msgs::ColorRGBA bodyColour();

/// Writes the meshes of insectUrdf into `directory` (made if missing). Throws InputError when a
/// file cannot be written.
void writeMeshes(const Insect& insect, const std::string& directory);

}  // namespace monarch_flight
