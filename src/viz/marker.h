#pragma once
#include <visualization_msgs/Marker.h>

#include <array>
#include <string>

#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

std_msgs::ColorRGBA colour(float r, float g, float b, float a = 1.0f);

/// An empty list of triangles in the axes of `frame`.
visualization_msgs::Marker triangleList(const std::string& frame, const std::string& group, int id,
                                        const ros::Time& stamp);

/// A corner of a triangle.
struct Corner {
  Eigen::Vector3f at;  ///< [m]
  std_msgs::ColorRGBA colour;
};
void addTriangle(visualization_msgs::Marker& list, const Corner& a, const Corner& b,
                 const Corner& c);

}  // namespace monarch_flight
