#include "monarch_flight/viz/pressure_cloud.h"

#include <array>
#include <cstring>

#include "monarch_flight/viz/frames.h"
#include "viz/float_cloud.h"

namespace monarch_flight {
namespace {

const std::vector<std::string> kFields = {"x", "y", "z", "dx", "dy", "p_upper", "p_lower", "jump"};
using Numbers = std::array<float, 8>;

/// Takes y of the wing told as a right one to its own axes, and back.
float mirroredY(float y, Side side) { return side == Side::kLeft ? 0.0f - y : y; }

}  // namespace

sensor_msgs::PointCloud2 pressureCloud(const SurfacePressure& surface, Side side,
                                       const ros::Time& stamp) {
  const char* frame = side == Side::kLeft ? frames::kLeftWing : frames::kRightWing;
  sensor_msgs::PointCloud2 cloud = floatCloud(kFields, surface.facets.size(), frame, stamp);
  std::uint8_t* out = cloud.data.data();
  for (const SurfacePressure::Facet& f : surface.facets) {
    const Numbers numbers{f.x,       mirroredY(f.y, side), 0.0f, f.dx, f.dy, f.p_upper,
                          f.p_lower, f.p_upper - f.p_lower};
    std::memcpy(out, numbers.data(), sizeof numbers);
    out += sizeof numbers;
  }
  return cloud;
}

std::optional<SurfacePressure> surfacePressure(const sensor_msgs::PointCloud2& cloud, Side side) {
  if (!isFloatCloud(cloud, kFields)) return std::nullopt;
  SurfacePressure surface;
  surface.facets.reserve(cloud.width);
  for (std::size_t i = 0; i < cloud.width; ++i) {
    Numbers n;
    std::memcpy(n.data(), cloud.data.data() + i * sizeof n, sizeof n);
    surface.facets.push_back({n[0], mirroredY(n[1], side), n[3], n[4], n[5], n[6]});
  }
  return surface;
}

}  // namespace monarch_flight
