#pragma once
#include <sensor_msgs/PointCloud2.h>

#include <optional>

#include "monarch_flight/fluid/fluid_model.h"

namespace monarch_flight {

/// Pressure on a wing's surface as numbers: a point a facet, in the frame of that wing, the left
/// one in its true axes. Fields, float32: x y z, the centre, z being 0 [m]; dx dy, the size [m];
/// p_upper p_lower, gauge pressure on the dorsal (-z) and the ventral (+z) side [Pa]; jump =
/// p_upper - p_lower, which pushes the wing along z [Pa].
sensor_msgs::PointCloud2 pressureCloud(const SurfacePressure& surface, Side side,
                                       const ros::Time& stamp);
/// What such a cloud was made of, the left wing as its mirror image; none where it is another
/// cloud.
std::optional<SurfacePressure> surfacePressure(const sensor_msgs::PointCloud2& cloud, Side side);

}  // namespace monarch_flight
