#pragma once
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include <optional>

#include "monarch_flight/run/case.h"
#include "monarch_flight/run/pressure_reference.h"

namespace monarch_flight {

/// The coloured wings of a case, from the clouds of their pressure.
class PressurePicture {
 public:
  explicit PressurePicture(const Case& c);
  visualization_msgs::MarkerArray legend() const;
  /// Takes the pressure of a wing. Returns the markers of all wings once it has those of one time;
  /// of a mirrored flight the right wing is enough.
  std::optional<visualization_msgs::MarkerArray> add(Side side,
                                                     const sensor_msgs::PointCloud2& cloud);

 private:
  PressureReference reference_;
  bool bare_wing_, mirrored_;
  double span_, lift_;  // [m]
  PerWing<std::optional<visualization_msgs::Marker>> wings_;
};

}  // namespace monarch_flight
