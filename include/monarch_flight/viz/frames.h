#pragma once
#include <geometry_msgs/Point.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/TransformStamped.h>

#include <vector>

#include "monarch_flight/insect/insect.h"

namespace monarch_flight {

/// Names of the tf tree, which are the links of the URDF, too: world -> world_ned; world ->
/// base_link -> body_frd -> stroke_plane -> right_wing_flapping -> right_wing_deviation ->
/// right_wing, the same for left_wing; body_frd -> abdomen. REP-103: world is ENU, base_link x
/// forward, y left, z up.
namespace frames {
constexpr char kWorld[] = "world";         ///< ENU
constexpr char kWorldNed[] = "world_ned";  ///< F_I: x north, y east, z down, same origin
constexpr char kBaseLink[] = "base_link";  ///< at the body's mass centre
constexpr char kBodyFrd[] = "body_frd";    ///< F_B: the same point, x forward, y right, z down
constexpr char kStrokePlane[] = "stroke_plane";             ///< F_S: F_B turned by beta about y
constexpr char kRightFlapping[] = "right_wing_flapping";    ///< F_S turned by flapping
constexpr char kRightDeviation[] = "right_wing_deviation";  ///< and by deviation
constexpr char kRightWing[] = "right_wing";  ///< F_R, at the wing's root: and by pitch
constexpr char kLeftFlapping[] = "left_wing_flapping";
constexpr char kLeftDeviation[] = "left_wing_deviation";
constexpr char kLeftWing[] = "left_wing";  ///< F_L, at the wing's root
constexpr char kAbdomen[] = "abdomen";     ///< F_A, at its joint
}  // namespace frames

/// Takes NED components to ENU components (its own inverse).
Eigen::Matrix3d nedToEnu();
/// Takes components in x forward, y right, z down to x forward, y left, z up (its own inverse).
Eigen::Matrix3d frdToFlu();
/// Attitude of base_link: takes its components to those of world.
Eigen::Matrix3d baseLinkAttitude(const BodyState& body);

geometry_msgs::Quaternion toQuaternion(const Eigen::Matrix3d& R);
geometry_msgs::Point toPoint(const Eigen::Vector3d& v);
geometry_msgs::Vector3 toVector3(const Eigen::Vector3d& v);

/// Where a wing's root lies in the frame stroke_plane [m].
Eigen::Vector3d wingRoot(const Insect& insect, Side side);

/// Transforms that never change: world_ned, body_frd, stroke_plane.
std::vector<geometry_msgs::TransformStamped> staticTransforms(const Insect& insect,
                                                              const ros::Time& stamp);
/// Transforms of one committed state: base_link, right_wing and those before it and, unless a bare
/// wing, the same of left_wing, abdomen.
std::vector<geometry_msgs::TransformStamped> movingTransforms(const Insect& insect,
                                                              const BodyState& body,
                                                              const JointAngles& angles,
                                                              const ros::Time& stamp);

}  // namespace monarch_flight
