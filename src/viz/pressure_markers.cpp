#include "monarch_flight/viz/pressure_markers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "monarch_flight/viz/colours.h"
#include "monarch_flight/viz/frames.h"

namespace monarch_flight {
namespace {

visualization_msgs::Marker blank(const char* frame, const std::string& group, int id, int type,
                                 const ros::Time& stamp) {
  visualization_msgs::Marker out;
  out.header.frame_id = frame;
  out.header.stamp = stamp;
  out.ns = group;
  out.id = id;
  out.type = type;
  out.action = visualization_msgs::Marker::ADD;
  out.pose.orientation.w = 1.0;
  out.scale.x = out.scale.y = out.scale.z = 1.0;
  out.color.r = out.color.g = out.color.b = out.color.a = 1.0f;
  out.frame_locked = true;
  return out;
}

// One rectangle in the plane z as two triangles with a colour each.
void addFacet(visualization_msgs::Marker& marker, const SurfacePressure::Facet& facet, double side,
              double z, const std_msgs::ColorRGBA& colour) {
  const auto corner = [&](double i, double j) {
    return toPoint({facet.x + 0.5 * i * facet.dx, side * (facet.y + 0.5 * j * facet.dy), z});
  };
  const geometry_msgs::Point a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1),
                             d = corner(-1, 1);
  marker.points.insert(marker.points.end(), {a, b, c, a, c, d});
  marker.colors.insert(marker.colors.end(), {colour, colour});
}

// At the newest pose of its frame, whatever the time.
visualization_msgs::Marker ofLegend(int id, int type) {
  return blank(frames::kLegend, "legend", id, type, ros::Time(0));
}

// Upright prism of square section; triangles keep their plain colours.
visualization_msgs::Marker colourBar(const Eigen::Vector3d& foot, double height, double width) {
  constexpr int kBars = 40;
  visualization_msgs::Marker bar = ofLegend(0, visualization_msgs::Marker::TRIANGLE_LIST);
  const auto corner = [&](int side, int level) {
    const double angle = 0.25 * M_PI + 0.5 * M_PI * side, r = width / std::sqrt(2.0);
    const Eigen::Vector3d p(r * std::cos(angle), r * std::sin(angle), height * level / kBars);
    return toPoint(foot + p);
  };
  for (int i = 0; i < kBars; ++i) {
    const std_msgs::ColorRGBA colour = divergingColour(2.0 * (i + 0.5) / kBars - 1.0);
    for (int side = 0; side < 4; ++side) {
      const geometry_msgs::Point a = corner(side, i), b = corner(side + 1, i),
                                 c = corner(side + 1, i + 1), d = corner(side, i + 1);
      bar.points.insert(bar.points.end(), {a, b, c, a, c, d});
      bar.colors.insert(bar.colors.end(), {colour, colour});
    }
  }
  return bar;
}

}  // namespace

visualization_msgs::Marker pressureMarker(const SurfacePressure& surface, Side side,
                                          const PressureReference& reference, double lift,
                                          const ros::Time& stamp) {
  const bool left = side == Side::kLeft;
  visualization_msgs::Marker out =
      blank(left ? frames::kLeftWing : frames::kRightWing, "pressure", left ? 1 : 0,
            visualization_msgs::Marker::TRIANGLE_LIST, stamp);
  out.points.reserve(12 * surface.facets.size());
  out.colors.reserve(4 * surface.facets.size());
  const double scale = 1.0 / (reference.dynamic * kPressureRange);
  const double sign = left ? -1.0 : 1.0;
  for (const SurfacePressure::Facet& facet : surface.facets) {
    addFacet(out, facet, sign, -lift, divergingColour(scale * facet.p_upper));
    addFacet(out, facet, sign, lift, divergingColour(scale * facet.p_lower));
  }
  return out;
}

visualization_msgs::MarkerArray pressureLegend(const PressureReference& reference, double span) {
  constexpr int kNumbers = 5;
  const double height = 0.9 * span;
  // World axes, from the body; to the right for who looks from the east, as rviz/monarch.rviz does.
  const Eigen::Vector3d right(-0.48, 0.88, 0.0);
  const Eigen::Vector3d foot = 1.5 * span * right - 0.5 * span * Eigen::Vector3d::UnitZ();
  visualization_msgs::MarkerArray out;
  out.markers.push_back(colourBar(foot, height, 0.06 * span));
  const auto write = [&](const char* text, double along, double up) {
    visualization_msgs::Marker label = ofLegend(static_cast<int>(out.markers.size()),
                                                visualization_msgs::Marker::TEXT_VIEW_FACING);
    label.pose.position = toPoint(foot + along * right + up * Eigen::Vector3d::UnitZ());
    label.scale.z = 0.09 * span;
    label.text = text;
    out.markers.push_back(label);
  };
  char text[64];
  for (int i = 0; i < kNumbers; ++i) {
    const double s = static_cast<double>(i) / (kNumbers - 1);
    std::snprintf(text, sizeof text, "%+.1f", kPressureRange * (2.0 * s - 1.0));
    write(text, 0.2 * span, s * height);
  }
  std::snprintf(text, sizeof text, "Cp at U_ref = %.2f m/s", reference.speed);
  write(text, 0.0, height + 0.14 * span);
  return out;
}

}  // namespace monarch_flight
