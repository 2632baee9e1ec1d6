#pragma once
#include <sensor_msgs/PointCloud2.h>

#include <vector>

#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/insect.h"

namespace monarch_flight {

/// Vortex points around the right wing and, unless a bare wing, around the left one, in frame
/// base_link. Fields, float32: x y z [m], rgb (blue to red: sign and square root of
/// the spanwise vorticity over the largest of the picture), q [1/s^2], omega_y (wing axes) [1/s].
sensor_msgs::PointCloud2 vortexCloud(const PerWing<std::vector<VortexPoint>>& points,
                                     const Insect& insect, const JointAngles& angles,
                                     const ros::Time& stamp);

}  // namespace monarch_flight
