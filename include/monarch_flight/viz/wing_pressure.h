#pragma once
#include <visualization_msgs/Marker.h>

#include <optional>

#include "monarch_flight/run/case.h"
#include "monarch_flight/run/pressure_reference.h"
#include "monarch_flight/viz/wing_sheet.h"

namespace monarch_flight {

/// A wing in the colours of its pressure coefficient: its true outline, the numbers of the facets
/// made smooth.
class WingPressure {
 public:
  WingPressure(const Case& c, Side side);
  /// Takes a picture of the wing, told as a right one.
  void take(const SurfacePressure& surface);
  /// A large |Cp| of the last picture: 98 % of the wing have less.
  double largest() const;
  /// Triangles of both sides of the wing, in the frame of `side`, which they move with until the
  /// next picture. Colours run from -limit to limit. Of mirrored wings the left one is made of the
  /// right one's pressure.
  visualization_msgs::Marker marker(Side side, double limit, const ros::Time& stamp) const;

 private:
  WingSheet sheet_;
  double per_pascal_, lift_;  // Cp of 1 Pa; distance of a coloured side from the wing's plane [m]
  std::optional<FacetMeans> means_;
  std::vector<double> upper_, lower_;  // Cp at the points of the sheet
};

}  // namespace monarch_flight
