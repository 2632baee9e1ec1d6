#pragma once
#include <monarch_flight/ColourScales.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include "monarch_flight/run/case.h"
#include "monarch_flight/viz/colours.h"
#include "monarch_flight/viz/vortices.h"
#include "monarch_flight/viz/wing_pressure.h"

namespace monarch_flight {

/// What is seen of the flow of one case, from the newest pictures of its wings. With mirrored wings
/// the pictures of the right wing serve both. Frames of the markers: viz/frames.h, plain.
class FlowScene {
 public:
  explicit FlowScene(const Case& c);

  /// Takes a picture of the pressure. False: it is none.
  bool take(Side side, const sensor_msgs::PointCloud2& cloud);
  /// Takes a picture of the flow, in the true axes of that wing.
  void take(Side side, const FlowPicture& picture, const ros::Time& stamp);
  /// How the wings stand in the world, for the light.
  void take(const BodyState& body, const JointAngles& angles);

  /// Vortices are where Q exceeds `level` (U / c)^2: U is the reference speed of the pressure
  /// coefficient (pressureReference), c the mean chord. Precondition: > 0.
  void setQLevel(double level);

  bool hasPressure() const { return static_cast<bool>(pressure_stamp_.right); }
  bool hasFlow() const { return static_cast<bool>(flow_stamp_.right); }
  /// Of all wings that have a picture.
  visualization_msgs::MarkerArray pressure() const;
  visualization_msgs::MarkerArray vortices() const;
  /// `share`: of the span, from root to tip.
  visualization_msgs::MarkerArray slice(double share) const;
  ColourScales scales() const;
  const Case& flown() const { return case_; }

 private:
  struct Seen {
    Side side;    // of the wing
    Side source;  // of the pictures
  };
  std::vector<Seen> seen() const;
  Eigen::Vector3d light(Side side) const;

  Case case_;
  double q_unit_;  // (U / c)^2 [1/s^2]
  double q_level_ = 0.04;
  PerWing<WingPressure> wings_;
  PerWing<std::optional<ros::Time>> pressure_stamp_, flow_stamp_;
  PerWing<FlowPicture> flow_;
  ScaleLimit cp_limit_, omega_limit_;
  std::optional<BodyState> body_;
  JointAngles angles_;
};

}  // namespace monarch_flight
