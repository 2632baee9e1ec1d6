#include "monarch_flight/ros_io/pressure_view.h"

#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/flight_messages.h"
#include "monarch_flight/ros_io/run_parameters.h"
#include "monarch_flight/viz/frames.h"

namespace monarch_flight {
namespace {

constexpr std::uint32_t kQueue = 100;

/// What stands before `end`, where a name ends with that.
std::optional<std::string> before(const std::string& name, const std::string& end) {
  if (name.size() < end.size()) return std::nullopt;
  const std::size_t size = name.size() - end.size();
  return name.compare(size, end.size(), end) == 0 ? std::optional(name.substr(0, size))
                                                  : std::nullopt;
}

}  // namespace

PressureView::PressureView() : names_(RunNames::ofThisNode()) {
  const auto here = [this](const char* topic) { return names_.topic(topic); };
  markers_ =
      node_.advertise<visualization_msgs::MarkerArray>(here(topics::kPressureMarkers), 10, true);
  legend_ =
      node_.advertise<visualization_msgs::MarkerArray>(here(topics::kPressureLegend), 1, true);
  transforms_ = node_.advertise<tf2_msgs::TFMessage>(topics::kTf, kQueue, true);
  case_ = node_.subscribe(here(topics::kCase), 1, &PressureView::onCase, this);
  tf_ = node_.subscribe(topics::kTf, kQueue, &PressureView::onTransforms, this);
  const auto listen = [this](const char* topic, Side side) {
    return node_.subscribe<sensor_msgs::PointCloud2>(
        names_.topic(topic), 10,
        [this, side](const sensor_msgs::PointCloud2ConstPtr& cloud) { onPressure(side, cloud); });
  };
  pressure_ = {listen(topics::kRightPressure, Side::kRight),
               listen(topics::kLeftPressure, Side::kLeft)};
}

void PressureView::onCase(const std_msgs::String& text) {
  if (picture_ && text.data == shown_) return;  // a bag that is played again
  if (picture_) newest_ = {};                   // of another flight
  try {
    picture_.emplace(caseFromText(text.data, topics::kCase, {}, configDirectory()));
  } catch (const InputError& e) {
    ROS_WARN("no colours of this flight: %s", e.what());
    return;
  }
  shown_ = text.data;
  showLegend();
  for (Side side : kSides) show(side);
}

void PressureView::onPressure(Side side, const sensor_msgs::PointCloud2ConstPtr& cloud) {
  newest_[side] = cloud;
  const char* wing = side == Side::kLeft ? frames::kLeftWing : frames::kRightWing;
  const auto prefix = before(cloud->header.frame_id, wing);
  if (prefix && prefix != prefix_) {
    prefix_ = prefix;
    showLegend();
    const auto body = bodies_.find(*prefix_);
    if (body != bodies_.end()) follow(body->second);
  }
  show(side);
}

void PressureView::showLegend() {
  if (picture_ && prefix_) legend_.publish(named(picture_->legend()));
}

void PressureView::show(Side side) {
  if (!picture_ || !prefix_ || !newest_[side]) return;
  if (const auto markers = picture_->add(side, *newest_[side])) markers_.publish(named(*markers));
}

visualization_msgs::MarkerArray PressureView::named(visualization_msgs::MarkerArray markers) const {
  for (visualization_msgs::Marker& marker : markers.markers)
    marker.header.frame_id = *prefix_ + marker.header.frame_id;
  return markers;
}

void PressureView::onTransforms(const tf2_msgs::TFMessage& transforms) {
  for (const geometry_msgs::TransformStamped& body : transforms.transforms) {
    const auto prefix = before(body.child_frame_id, frames::kBaseLink);
    if (!prefix) continue;
    bodies_[*prefix] = body;
    if (prefix == prefix_) follow(body);
  }
}

/// The legend's frame.
void PressureView::follow(const geometry_msgs::TransformStamped& body) {
  tf2_msgs::TFMessage out;
  out.transforms.push_back(body);
  out.transforms[0].child_frame_id = *prefix_ + frames::kLegend;
  out.transforms[0].transform.rotation = geometry_msgs::Quaternion();
  out.transforms[0].transform.rotation.w = 1.0;
  transforms_.publish(out);
}

}  // namespace monarch_flight
