#pragma once
#include <visualization_msgs/MarkerArray.h>

#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// Arrows of the air's forces: on each wing at its centre of pressure, in the frame of that wing,
/// and the sum of both at the body's mass centre, in world_ned. An arrow as long as the wing's span
/// is a force of twice the insect's weight (without a weight: 0.01 N). `loads`: the left wing's as
/// its mirror image; `force`: NED [N]; `body`: mass centre, NED [m].
visualization_msgs::MarkerArray forceArrows(const Case& c, const PerWing<Loads>& loads,
                                            const Eigen::Vector3d& force,
                                            const Eigen::Vector3d& body, const ros::Time& stamp);

/// Where the wing's plane meets the line of the force, within the wing's box [m].
Eigen::Vector3d centreOfPressure(const Planform& wing, const Loads& loads);

}  // namespace monarch_flight
