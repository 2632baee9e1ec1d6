#include "monarch_flight/ros_io/flight_messages.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/ros_io/fluid_conversions.h"
#include "monarch_flight/ros_io/step_conversions.h"
#include "monarch_flight/viz/frames.h"
#include "monarch_flight/viz/model_markers.h"
#include "monarch_flight/viz/pressure_cloud.h"
#include "monarch_flight/viz/urdf.h"

namespace monarch_flight {
namespace {

constexpr double kPathPosesPerFlap = 32.0;  // at first
constexpr std::size_t kPathLimit = 400;     // poses; then every second goes and the stride doubles
constexpr double kDiagnosticsPerFlap = 20.0;
constexpr double kStepsWithoutPeriod = 1000.0;  // stands for a flap where there is none

std::uint32_t stride(const TimeGrid& time, double per_flap) {
  const double flap = time.period > 0.0 ? time.stepsPerFlap() : kStepsWithoutPeriod;
  return static_cast<std::uint32_t>(std::max(1.0, std::round(flap / per_flap)));
}

geometry_msgs::Pose pose(const BodyState& body) {
  geometry_msgs::Pose out;
  out.position = toPoint(nedToEnu() * body.x);
  out.orientation = toQuaternion(baseLinkAttitude(body));
  return out;
}

nav_msgs::Odometry odometry(const BodyState& body, const ros::Time& stamp) {
  nav_msgs::Odometry out;
  out.header.stamp = stamp;
  out.header.frame_id = frames::kWorld;
  out.child_frame_id = frames::kBaseLink;
  out.pose.pose = pose(body);
  out.twist.twist.linear = toVector3(frdToFlu() * body.R_IB().transpose() * body.v);
  out.twist.twist.angular = toVector3(frdToFlu() * body.Omega_B);
  return out;
}

sensor_msgs::JointState jointState(const JointAngles& a, bool bare_wing, const ros::Time& stamp) {
  sensor_msgs::JointState out;
  out.header.stamp = stamp;
  const auto add = [&out](const char* name, const Coordinate& c) {
    out.name.push_back(name);
    out.position.push_back(c.q);
    out.velocity.push_back(c.qd);
  };
  add(joints::kRightFlap, a.wings.right.phi);
  add(joints::kRightDeviation, a.wings.right.psi);
  add(joints::kRightPitch, a.wings.right.theta);
  if (bare_wing) return out;
  add(joints::kLeftFlap, a.wings.left.phi);
  add(joints::kLeftDeviation, a.wings.left.psi);
  add(joints::kLeftPitch, a.wings.left.theta);
  add(joints::kAbdomen, a.theta_A);
  return out;
}

geometry_msgs::Vector3Stamped wind(const Wind& met, const ros::Time& stamp) {
  geometry_msgs::Vector3Stamped out;
  out.header.stamp = stamp;
  out.header.frame_id = frames::kWorld;
  out.vector = toVector3(nedToEnu() * met.v);
  return out;
}

// In the wing's true axes.
geometry_msgs::WrenchStamped wingWrench(const PerWing<Loads>& all, bool left,
                                        const ros::Time& stamp) {
  const Loads loads = left ? mirrored(all.left) : all.right;
  geometry_msgs::WrenchStamped out;
  out.header.stamp = stamp;
  out.header.frame_id = left ? frames::kLeftWing : frames::kRightWing;
  out.wrench.force = toVector3(loads.force());
  out.wrench.torque = toVector3(loads.moment());
  return out;
}

// In the wing's true axes.
FlowBlock flowBlock(const FlowPicture& picture, Side side, const ros::Time& stamp) {
  const bool left = side == Side::kLeft;
  FlowBlock out = toMessage(left ? mirrored(picture) : picture);
  out.header.stamp = stamp;
  out.header.frame_id = left ? frames::kLeftWing : frames::kRightWing;
  return out;
}

/// Frames that a message names.
template <class Message>
auto nameFrames(Message& message, const RunNames& names)
    -> std::enable_if_t<ros::message_traits::HasHeader<Message>::value> {
  if (!message.header.frame_id.empty())
    message.header.frame_id = names.frame(message.header.frame_id);
  if constexpr (std::is_same_v<Message, nav_msgs::Odometry>)
    message.child_frame_id = names.frame(message.child_frame_id);
}
template <class Message>
auto nameFrames(Message&, const RunNames&)
    -> std::enable_if_t<!ros::message_traits::HasHeader<Message>::value> {}
void nameFrames(visualization_msgs::MarkerArray& message, const RunNames& names) {
  for (visualization_msgs::Marker& marker : message.markers)
    marker.header.frame_id = names.frame(marker.header.frame_id);
}
void nameFrames(tf2_msgs::TFMessage& message, const RunNames& names) {
  for (geometry_msgs::TransformStamped& transform : message.transforms) {
    transform.header.frame_id = names.frame(transform.header.frame_id);
    transform.child_frame_id = names.frame(transform.child_frame_id);
  }
}

template <class Message>
StampedMessage prototype(const char* topic, bool latched = false) {
  return {topic, ros::Time(), Message(), latched};
}

}  // namespace

ros::Time stampOf(std::uint32_t step, const TimeGrid& time) {
  const auto ns = static_cast<std::uint64_t>(std::llround(step * time.dt * 1e9));
  return ros::Time(static_cast<std::uint32_t>(1 + ns / 1000000000ull),
                   static_cast<std::uint32_t>(ns % 1000000000ull));
}

FlightMessages::FlightMessages(const Case& c, const RunNames& names)
    : case_(c),
      names_(names),
      path_stride_(stride(c.time, kPathPosesPerFlap)),
      diagnostics_stride_(stride(c.time, kDiagnosticsPerFlap)) {
  path_.header.frame_id = frames::kWorld;
}

std::vector<StampedMessage> FlightMessages::topics() const {
  std::vector<StampedMessage> out = {
      prototype<rosgraph_msgs::Clock>(topics::kClock),
      prototype<tf2_msgs::TFMessage>(topics::kTf),
      prototype<tf2_msgs::TFMessage>(topics::kTfStatic, true),
      prototype<sensor_msgs::JointState>(topics::kJointStates),
      prototype<diagnostic_msgs::DiagnosticArray>(topics::kDiagnostics),
      prototype<std_msgs::String>(topics::kCase, true),
      prototype<visualization_msgs::MarkerArray>(topics::kModel, true),
      prototype<FlightState>(topics::kState),
      prototype<nav_msgs::Odometry>(topics::kOdometry),
      prototype<nav_msgs::Path>(topics::kPath, true),
      prototype<geometry_msgs::Vector3Stamped>(topics::kWind),
      prototype<geometry_msgs::WrenchStamped>(topics::kRightWrench),
      prototype<sensor_msgs::PointCloud2>(topics::kRightPressure, true),
      prototype<FlowBlock>(topics::kRightFlow, true),
      prototype<StepIterations>(topics::kIterations)};
  if (!case_.insect.bare_wing) {
    out.push_back(prototype<geometry_msgs::WrenchStamped>(topics::kLeftWrench));
  }
  if (!case_.mirrored) {
    out.push_back(prototype<sensor_msgs::PointCloud2>(topics::kLeftPressure, true));
    out.push_back(prototype<FlowBlock>(topics::kLeftFlow, true));
  }
  name(out);
  return out;
}

/// Puts the names of the run in place of the plain ones.
void FlightMessages::name(std::vector<StampedMessage>& messages) const {
  for (StampedMessage& message : messages) {
    message.topic = names_.topic(message.topic);
    std::visit([this](auto& content) { nameFrames(content, names_); }, message.message);
  }
}

std::vector<StampedMessage> FlightMessages::opening() const {
  const ros::Time stamp = stampOf(0, case_.time);
  tf2_msgs::TFMessage fixed;
  fixed.transforms = staticTransforms(case_.insect, stamp);
  std_msgs::String text;
  text.data = case_.resolved_yaml;
  std::vector<StampedMessage> out = {{topics::kTfStatic, stamp, fixed, true},
                                     {topics::kCase, stamp, text, true},
                                     {topics::kModel, stamp, modelMarkers(case_.insect), true}};
  name(out);
  return out;
}

std::vector<StampedMessage> FlightMessages::of(const CommittedStep& step) {
  const ros::Time stamp = stampOf(step.step, case_.time);
  const bool bare = case_.insect.bare_wing;
  std::vector<StampedMessage> out;
  out.reserve(15);
  rosgraph_msgs::Clock clock;
  clock.clock = stamp;
  tf2_msgs::TFMessage moving;
  moving.transforms = movingTransforms(case_.insect, step.interface.body, step.angles, stamp);
  out.push_back({topics::kClock, stamp, clock});
  out.push_back({topics::kTf, stamp, std::move(moving)});
  out.push_back({topics::kJointStates, stamp, jointState(step.angles, bare, stamp)});
  out.push_back({topics::kState, stamp, flightState(step, stamp)});
  out.push_back({topics::kOdometry, stamp, odometry(step.interface.body, stamp)});
  out.push_back({topics::kWind, stamp, wind(step.guided.wind, stamp)});
  out.push_back({topics::kRightWrench, stamp, wingWrench(step.loads, false, stamp)});
  if (!bare) out.push_back({topics::kLeftWrench, stamp, wingWrench(step.loads, true, stamp)});
  out.push_back({topics::kIterations, stamp, stepIterations(step, stamp)});
  if (growPath(step, stamp)) out.push_back({topics::kPath, stamp, path_, true});
  if (step.step % diagnostics_stride_ == 0 || step.retried()) {
    out.push_back({topics::kDiagnostics, stamp, diagnostics(step, stamp)});
  }
  addPictures(step, stamp, out);
  name(out);
  return out;
}

bool FlightMessages::growPath(const CommittedStep& step, const ros::Time& stamp) {
  if (step.step % path_stride_ != 0) return false;
  if (path_.poses.size() >= kPathLimit) {
    std::vector<geometry_msgs::PoseStamped> kept;
    for (std::size_t i = 0; i < path_.poses.size(); i += 2) kept.push_back(path_.poses[i]);
    path_.poses = std::move(kept);
    path_stride_ *= 2;
    if (step.step % path_stride_ != 0) return false;
  }
  geometry_msgs::PoseStamped here;
  here.header.stamp = stamp;
  here.header.frame_id = frames::kWorld;
  here.pose = pose(step.interface.body);
  path_.header.stamp = stamp;
  path_.poses.push_back(here);
  return true;
}

void FlightMessages::addPictures(const CommittedStep& step, const ros::Time& stamp,
                                 std::vector<StampedMessage>& out) const {
  for (Side side : case_.sides()) {
    const bool left = side == Side::kLeft;
    const SurfacePressure& surface = step.surface[side];
    const FlowPicture& flow = step.picture[side];
    if (!surface.facets.empty()) {
      out.push_back({left ? topics::kLeftPressure : topics::kRightPressure, stamp,
                     pressureCloud(surface, side, stamp), true});
    }
    if (!flow.empty()) {
      out.push_back({left ? topics::kLeftFlow : topics::kRightFlow, stamp,
                     flowBlock(flow, side, stamp), true});
    }
  }
}

void FlightMessages::memory(StateVisitor& state) {
  namespace ser = ros::serialization;
  if (!state.has("path")) return;  // nothing was published before
  state("path_stride", path_stride_);
  std::vector<char> bytes(state.loading() ? 0 : ser::serializationLength(path_));
  if (!state.loading()) {
    ser::OStream out(reinterpret_cast<std::uint8_t*>(bytes.data()),
                     static_cast<std::uint32_t>(bytes.size()));
    ser::serialize(out, path_);
  }
  state.bytes("path", bytes);
  if (state.loading()) {
    ser::IStream in(reinterpret_cast<std::uint8_t*>(bytes.data()),
                    static_cast<std::uint32_t>(bytes.size()));
    ser::deserialize(in, path_);
  }
}

MessageSink::MessageSink(const Case& c, const RunNames& names, std::vector<MessageOutput*> outputs,
                         StateVisitor* resumed)
    : case_(c), names_(names), messages_(c, names), outputs_(std::move(outputs)) {
  if (resumed != nullptr) messages_.memory(*resumed);
  const std::vector<StampedMessage> topics = messages_.topics();
  for (MessageOutput* output : outputs_) output->open(topics);
  for (MessageOutput* output : outputs_) {
    if (output->resumed()) continue;
    for (const StampedMessage& message : messages_.opening()) output->write(message);
  }
}

void MessageSink::onCheckpoint(StateVisitor& state) {
  messages_.memory(state);
  for (MessageOutput* output : outputs_) output->onCheckpoint(state);
}

void MessageSink::onStep(const CommittedStep& step) { write(messages_.of(step)); }

void MessageSink::onReset() {
  messages_ = FlightMessages(case_, names_);
  for (MessageOutput* output : outputs_) output->restart();
  write(messages_.opening());
}

void MessageSink::onEnd(const std::string&) {
  for (MessageOutput* output : outputs_) output->close();
}

void MessageSink::write(const std::vector<StampedMessage>& messages) {
  for (const StampedMessage& message : messages) {
    for (MessageOutput* output : outputs_) output->write(message);
  }
}

}  // namespace monarch_flight
