#include "monarch_flight/viz/model_markers.h"

#include "monarch_flight/viz/frames.h"
#include "monarch_flight/viz/mesh.h"
#include "monarch_flight/viz/urdf.h"

namespace monarch_flight {
namespace {

/// At the newest pose of its frame, whatever the time.
visualization_msgs::Marker part(const Mesh& mesh, const char* frame, int id,
                                const std_msgs::ColorRGBA& colour) {
  visualization_msgs::Marker out;
  out.header.frame_id = frame;
  out.ns = "insect";
  out.id = id;
  out.type = visualization_msgs::Marker::TRIANGLE_LIST;
  out.action = visualization_msgs::Marker::ADD;
  out.pose.orientation.w = 1.0;
  out.scale.x = out.scale.y = out.scale.z = 1.0;
  out.color = colour;
  out.frame_locked = true;
  out.points.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const Eigen::Vector3f& corner : triangle)
      out.points.push_back(toPoint(corner.cast<double>()));
  }
  return out;
}

}  // namespace

visualization_msgs::MarkerArray modelMarkers(const Insect& insect) {
  visualization_msgs::MarkerArray out;
  const auto add = [&out](const Mesh& mesh, const char* frame, const std_msgs::ColorRGBA& colour) {
    out.markers.push_back(part(mesh, frame, static_cast<int>(out.markers.size()), colour));
  };
  add(wingMesh(insect.wings.right.planform, false), frames::kRightWing, wingColour());
  if (insect.bare_wing) return out;
  add(wingMesh(insect.wings.left.planform, true), frames::kLeftWing, wingColour());
  add(thoraxMesh(insect), frames::kBodyFrd, bodyColour());
  add(abdomenMesh(insect), frames::kAbdomen, bodyColour());
  return out;
}

}  // namespace monarch_flight
