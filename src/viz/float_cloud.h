#pragma once
#include <sensor_msgs/PointCloud2.h>

#include <string>
#include <vector>

namespace monarch_flight {

/// A cloud of so many points with these fields, each a float32, all zero.
sensor_msgs::PointCloud2 floatCloud(const std::vector<std::string>& fields, std::size_t points,
                                    const std::string& frame, const ros::Time& stamp);
/// Whether it has exactly these fields in this order, and the data of all its points.
bool isFloatCloud(const sensor_msgs::PointCloud2& cloud, const std::vector<std::string>& fields);

}  // namespace monarch_flight
