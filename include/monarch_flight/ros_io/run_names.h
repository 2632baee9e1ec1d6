#pragma once
#include <string>

namespace monarch_flight {

/// Names in the graph of a master, as RunNames::topic takes them: "/x" is absolute, "x" lies in the
/// namespace of the run, "../x" beside it.
namespace topics {
constexpr char kClock[] = "/clock";
constexpr char kTf[] = "/tf";
constexpr char kTfStatic[] = "/tf_static";
constexpr char kDiagnostics[] = "/diagnostics";
constexpr char kJointStates[] = "../joint_states";
constexpr char kCase[] = "case";
constexpr char kModel[] = "model";
constexpr char kState[] = "state";
constexpr char kOdometry[] = "odom";
constexpr char kPath[] = "path";
constexpr char kWind[] = "wind";
constexpr char kRightWrench[] = "right_wing/wrench";
constexpr char kLeftWrench[] = "left_wing/wrench";
constexpr char kRightPressure[] = "right_wing/pressure";
constexpr char kLeftPressure[] = "left_wing/pressure";
constexpr char kRightFlow[] = "right_wing/flow";
constexpr char kLeftFlow[] = "left_wing/flow";
constexpr char kIterations[] = "iterations";
// Of FlowView, made from those above: neither from the coordinator nor in a bag.
constexpr char kInsectMarkers[] = "insect_markers";
constexpr char kPressureMarkers[] = "pressure_markers";
constexpr char kVortexMarkers[] = "vortex_markers";
constexpr char kSliceMarkers[] = "slice_markers";
constexpr char kForceMarkers[] = "force_markers";
constexpr char kColourScales[] = "colour_scales";
// Heard by FlowView.
constexpr char kQLevel[] = "flow_view/q_level";
constexpr char kSliceAt[] = "flow_view/slice_at";
}  // namespace topics

/// Where one run lives among others on the same master: the namespace of its nodes, parameters and
/// topics, and what stands before the names of its frames.
class RunNames {
 public:
  /// Where the launch files put a run that is alone: namespace /monarch_flight, plain frames.
  RunNames() = default;
  /// `space`: absolute, as "/lab/monarch_flight". `frame_prefix`: empty: that of the namespace,
  /// which is "lab/" there.
  explicit RunNames(const std::string& space, const std::string& frame_prefix = "");
  /// Of the running node: its namespace, and the parameter frame_prefix in it.
  static RunNames ofThisNode();

  const std::string& space() const { return space_; }
  /// Absolute name of a topic or a parameter (names as in `topics`).
  std::string topic(const std::string& name) const;
  /// Of a frame of this insect; world and world_ned are everybody's.
  std::string frame(const std::string& name) const;
  /// "monarch_flight/coordinator: ", before the name of a diagnostic status.
  std::string diagnosticPrefix() const;

 private:
  std::string space_ = "/monarch_flight";
  std::string frame_prefix_;
};

}  // namespace monarch_flight
