#include "monarch_flight/viz/vortices.h"

#include <algorithm>
#include <cmath>

#include "monarch_flight/viz/colours.h"
#include "monarch_flight/viz/frames.h"
#include "viz/marker.h"

namespace monarch_flight {
namespace {

visualization_msgs::Marker ofWing(const std::string& group, Side side, const ros::Time& stamp) {
  const bool left = side == Side::kLeft;
  return triangleList(left ? frames::kLeftWing : frames::kRightWing, group, left ? 1 : 0, stamp);
}

Eigen::Vector3f imaged(const Eigen::Vector3f& v, bool mirrored) {
  return {v.x(), mirrored ? -v.y() : v.y(), v.z()};
}

/// Of what faces away from the light, and what faces it.
void shade(std_msgs::ColorRGBA& colour, double cosine) {
  constexpr double kDark = 0.5, kBright = 1.05;
  const double half = 0.5 + 0.5 * cosine;
  const auto by = static_cast<float>(kDark + (kBright - kDark) * half);
  for (float* part : {&colour.r, &colour.g, &colour.b}) *part = std::min(1.0f, by * *part);
}

/// Clear where there is no vorticity.
float sliceOpacity(double value) {
  return static_cast<float>(std::min(0.9, 1.5 * std::abs(value)));
}

}  // namespace

double largestVorticity(const FlowPicture& picture, double q) {
  std::vector<int> sizes;
  for (std::size_t n = 0; n < picture.points(); ++n) {
    if (double(picture.step) * picture.q_root[n] > std::sqrt(q))
      sizes.push_back(std::abs(int{picture.omega_y[n]}));
  }
  if (sizes.empty()) return 0.0;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(0.85 * double(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  return double(picture.step) * *at;
}

visualization_msgs::Marker vortexMarker(const IsoSurface& surface, Side side, bool mirrored,
                                        const VortexLook& look, const ros::Time& stamp) {
  visualization_msgs::Marker out = ofWing("vortices", side, stamp);
  out.points.reserve(3 * surface.triangles.size());
  out.colors.reserve(3 * surface.triangles.size());
  const auto corner = [&](std::uint32_t n) -> Corner {
    const Eigen::Vector3f normal = imaged(surface.normals[n], mirrored);
    Corner c{imaged(surface.points[n], mirrored),
             vorticityColour(double(surface.omega_y[n]) / look.limit)};
    shade(c.colour, normal.cast<double>().dot(look.light));
    c.colour.a = look.opacity;
    return c;
  };
  std::vector<Corner> corners;
  corners.reserve(surface.points.size());
  for (std::uint32_t n = 0; n < surface.points.size(); ++n) corners.push_back(corner(n));
  for (const auto& t : surface.triangles)
    addTriangle(out, corners[t[0]], corners[t[1]], corners[t[2]]);
  if (out.points.empty()) out.action = visualization_msgs::Marker::DELETE;
  return out;
}

visualization_msgs::Marker sliceMarker(const FlowPicture& picture, Side side, bool mirrored,
                                       double at, double limit, const ros::Time& stamp) {
  visualization_msgs::Marker out = ofWing("slice", side, stamp);
  const auto [nx, ny, nz] = picture.size;
  const double place = (at - double(picture.origin[1])) / double(picture.spacing);
  out.action = visualization_msgs::Marker::DELETE;
  if (picture.empty() || place < 0.0 || place > double(ny - 1)) return out;
  out.action = visualization_msgs::Marker::ADD;
  const auto j = std::min<std::size_t>(static_cast<std::size_t>(place), ny - 2);
  const double share = place - double(j);
  const auto corner = [&, nx = nx, ny = ny](std::uint32_t i, std::uint32_t k) -> Corner {
    const std::size_t n = (k * ny + j) * nx + i;
    const double omega =
        double(picture.step) * ((1 - share) * picture.omega_y[n] + share * picture.omega_y[n + nx]);
    const Eigen::Vector3f p(picture.origin[0] + picture.spacing * static_cast<float>(i),
                            static_cast<float>(at),
                            picture.origin[2] + picture.spacing * static_cast<float>(k));
    Corner c{imaged(p, mirrored), vorticityColour(omega / limit)};
    c.colour.a = sliceOpacity(omega / limit);
    return c;
  };
  for (std::uint32_t k = 0; k + 1 < nz; ++k) {
    for (std::uint32_t i = 0; i + 1 < nx; ++i) {
      const Corner a = corner(i, k), b = corner(i + 1, k), c = corner(i + 1, k + 1),
                   d = corner(i, k + 1);
      addTriangle(out, a, b, c);
      addTriangle(out, a, c, d);
    }
  }
  return out;
}

}  // namespace monarch_flight
