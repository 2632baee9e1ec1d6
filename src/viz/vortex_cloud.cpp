#include "monarch_flight/viz/vortex_cloud.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "monarch_flight/viz/colours.h"
#include "monarch_flight/viz/frames.h"
#include "viz/float_cloud.h"

namespace monarch_flight {
namespace {

// PCL's and rviz's packing of a colour into the bits of a float.
float packed(const std_msgs::ColorRGBA& colour) {
  const auto byte = [](float c) { return static_cast<std::uint32_t>(std::lround(255.0f * c)); };
  const std::uint32_t bits = byte(colour.r) << 16 | byte(colour.g) << 8 | byte(colour.b);
  float out;
  std::memcpy(&out, &bits, sizeof out);
  return out;
}

}  // namespace

sensor_msgs::PointCloud2 vortexCloud(const PerWing<std::vector<VortexPoint>>& points,
                                     const Insect& insect, const JointAngles& angles,
                                     const ros::Time& stamp) {
  const Sides sides{insect.bare_wing ? 1U : 2U};
  std::size_t count = 0;
  float largest = 0.0f;
  for (Side side : sides) {
    count += points[side].size();
    for (const VortexPoint& p : points[side]) largest = std::max(largest, std::abs(p.omega_y));
  }
  sensor_msgs::PointCloud2 cloud =
      floatCloud({"x", "y", "z", "rgb", "q", "omega_y"}, count, frames::kBaseLink, stamp);
  std::uint8_t* out = cloud.data.data();
  for (Side side : sides) {
    // In the mirror the left wing is a right one.
    const Eigen::Matrix3d Q = wingAttitude(Side::kRight, insect.beta, angles.wings[side]);
    for (const VortexPoint& p : points[side]) {
      Eigen::Vector3d r =
          insect.wings[side].plate.mu + Q * Eigen::Vector3d(p.x, p.y, p.z);  // body axes
      if (side == Side::kLeft) r.y() = -r.y();
      const Eigen::Vector3f f = (frdToFlu() * r).cast<float>();
      const float share = largest > 0.0f ? std::abs(p.omega_y) / largest : 0.0f;
      const float shade = std::copysign(std::sqrt(share), p.omega_y);
      const float values[6] = {f.x(), f.y(), f.z(), packed(divergingColour(shade)), p.q, p.omega_y};
      std::memcpy(out, values, sizeof values);
      out += sizeof values;
    }
  }
  return cloud;
}

}  // namespace monarch_flight
