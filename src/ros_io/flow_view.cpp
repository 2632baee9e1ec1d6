#include "monarch_flight/ros_io/flow_view.h"

#include <cmath>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/fluid_conversions.h"
#include "monarch_flight/ros_io/run_parameters.h"
#include "monarch_flight/ros_io/state_conversions.h"
#include "monarch_flight/viz/force_arrows.h"
#include "monarch_flight/viz/frames.h"

namespace monarch_flight {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

const ros::WallDuration kForcesEvery(1.0 / 30.0);  // arrows follow every step

bool isQLevel(double level) { return std::isfinite(level) && level > 0.0; }
bool isShare(double share) { return share >= 0.0 && share <= 1.0; }

double parameter(const std::string& name, double usual, bool (*good)(double), const char* range) {
  const double value = ros::param::param("~" + name, usual);
  if (good(value)) return value;
  throw InputError(name + " = " + std::to_string(value) + ": must be " + range + "; " +
                   std::to_string(usual) + " is usual");
}

bool endsWith(const std::string& name, const std::string& end) {
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

bool isWing(const Marker& marker) {
  return endsWith(marker.header.frame_id, frames::kRightWing) ||
         endsWith(marker.header.frame_id, frames::kLeftWing);
}

bool same(const ColourScales& a, const ColourScales& b) {
  return a.scales.size() == b.scales.size() &&
         std::equal(a.scales.begin(), a.scales.end(), b.scales.begin(),
                    [](const ColourScale& x, const ColourScale& y) {
                      return x.quantity == y.quantity && x.limit == y.limit;
                    });
}

}  // namespace

FlowView::FlowView()
    : names_(RunNames::ofThisNode()),
      q_level_(parameter("q_level", 0.04, isQLevel, "above 0")),
      slice_at_(parameter("slice_at", 0.5, isShare, "in [0, 1]")) {
  if (!hasIsoSurfaces())
    ROS_WARN("this build has no VTK: no vortices are shown (scripts/install panel, build again)");
  // Whoever comes sees the newest picture at once.
  const auto offer = [this](const char* topic, void (FlowView::*show)()) {
    const auto changed = [this, show](const ros::SingleSubscriberPublisher&) {
      (this->*show)();
      showInsect();
    };
    return node_.advertise<MarkerArray>(names_.topic(topic), 4, changed, changed);
  };
  insect_ = node_.advertise<MarkerArray>(names_.topic(topics::kInsectMarkers), 4, true);
  scales_ = node_.advertise<ColourScales>(names_.topic(topics::kColourScales), 1, true);
  pressure_ = offer(topics::kPressureMarkers, &FlowView::showPressure);
  vortices_ = offer(topics::kVortexMarkers, &FlowView::showVortices);
  slice_ = offer(topics::kSliceMarkers, &FlowView::showSlice);
  forces_ = offer(topics::kForceMarkers, &FlowView::showForces);
  listen();
}

void FlowView::listen() {
  const auto hear = [this](const char* topic, auto method) {
    heard_.push_back(node_.subscribe(names_.topic(topic), 1, method, this));
  };
  hear(topics::kCase, &FlowView::onCase);
  hear(topics::kModel, &FlowView::onModel);
  hear(topics::kState, &FlowView::onState);
  hear(topics::kQLevel, &FlowView::onQLevel);
  hear(topics::kSliceAt, &FlowView::onSliceAt);
  for (Side side : kSides) {
    const bool left = side == Side::kLeft;
    heard_.push_back(node_.subscribe<sensor_msgs::PointCloud2>(
        names_.topic(left ? topics::kLeftPressure : topics::kRightPressure), 1,
        [this, side](const sensor_msgs::PointCloud2ConstPtr& cloud) {
          clouds_[side] = cloud;
          if (scene_) onPressure(side, *cloud);
        }));
    heard_.push_back(
        node_.subscribe<FlowBlock>(names_.topic(left ? topics::kLeftFlow : topics::kRightFlow), 1,
                                   [this, side](const FlowBlockConstPtr& block) {
                                     blocks_[side] = block;
                                     if (scene_) onFlow(side, *block);
                                   }));
  }
}

void FlowView::onCase(const std_msgs::String& text) {
  if (scene_ && text.data == shown_) return;  // a bag that is played again
  if (scene_) clear();                        // of another flight
  try {
    scene_.emplace(caseFromText(text.data, topics::kCase, {}, configDirectory()));
  } catch (const InputError& e) {
    ROS_WARN("nothing is shown of this flight's air: %s", e.what());
    return;
  }
  shown_ = text.data;
  scene_->setQLevel(q_level_);
  for (Side side : kSides) {
    if (clouds_[side]) onPressure(side, *clouds_[side]);
    if (blocks_[side]) onFlow(side, *blocks_[side]);
  }
}

void FlowView::clear() {
  scene_.reset();
  clouds_ = {};
  blocks_ = {};
  state_.reset();
  MarkerArray none;
  none.markers.resize(1);
  none.markers[0].action = Marker::DELETEALL;
  for (ros::Publisher* shown : {&pressure_, &vortices_, &slice_, &forces_}) shown->publish(none);
}

void FlowView::onModel(const MarkerArray& model) {
  model_ = model;
  for (const Marker& part : model.markers) learnPrefix(part.header.frame_id);
  showInsect();
}

void FlowView::onPressure(Side side, const sensor_msgs::PointCloud2& cloud) {
  const bool first = !scene_->hasPressure();
  if (!learnPrefix(cloud.header.frame_id) || !scene_->take(side, cloud)) return;
  showPressure();
  if (first) showInsect();
  showScales();
}

void FlowView::onFlow(Side side, const FlowBlock& block) {
  if (!learnPrefix(block.header.frame_id) || !problem(block).empty()) return;
  scene_->take(side, fromMessage(block), block.header.stamp);
  showVortices();
  showSlice();
  showScales();
}

void FlowView::onState(const FlightStateConstPtr& state) {
  state_ = state;
  if (forces_.getNumSubscribers() == 0) return;
  const ros::WallTime now = ros::WallTime::now();
  if (now - forces_shown_ < kForcesEvery) return;
  forces_shown_ = now;
  showForces();
}

void FlowView::onQLevel(const std_msgs::Float64& level) {
  if (!isQLevel(level.data)) {
    ROS_WARN("q_level = %g is not taken: must be above 0", level.data);
    return;
  }
  q_level_ = level.data;
  if (scene_) scene_->setQLevel(q_level_);
  showVortices();
}

void FlowView::onSliceAt(const std_msgs::Float64& share) {
  if (!isShare(share.data)) {
    ROS_WARN("slice_at = %g is not taken: must be in [0, 1]", share.data);
    return;
  }
  slice_at_ = share.data;
  showSlice();
}

/// Wings in their own pattern give way to those coloured by pressure.
void FlowView::showInsect() {
  if (model_.markers.empty()) return;
  const bool pressed = scene_ && scene_->hasPressure() && pressure_.getNumSubscribers() > 0;
  MarkerArray out = model_;
  for (Marker& part : out.markers) {
    if (!pressed || !isWing(part)) continue;
    part.action = Marker::DELETE;
    part.points.clear();
    part.colors.clear();
  }
  insect_.publish(out);
}

void FlowView::showPressure() {
  if (scene_ && pressure_.getNumSubscribers() > 0) publish(pressure_, scene_->pressure());
}

void FlowView::showVortices() {
  if (!scene_ || vortices_.getNumSubscribers() == 0) return;
  if (state_) {
    JointAngles angles;
    angles.wings = {fromMessage(state_->right_wing), fromMessage(state_->left_wing)};
    scene_->take(fromMessage(state_->body), angles);
  }
  publish(vortices_, scene_->vortices());
}

void FlowView::showSlice() {
  if (scene_ && slice_.getNumSubscribers() > 0) publish(slice_, scene_->slice(slice_at_));
}

void FlowView::showForces() {
  if (!scene_ || !state_ || forces_.getNumSubscribers() == 0) return;
  const PerWing<Loads> loads{fromMessage(state_->right_loads), fromMessage(state_->left_loads)};
  const auto& f = state_->force;
  publish(forces_, forceArrows(scene_->flown(), loads, {f.x, f.y, f.z}, fromMessage(state_->body).x,
                               state_->header.stamp));
}

void FlowView::showScales() {
  const ColourScales now = scene_->scales();
  if (same(now, scales_shown_)) return;
  scales_shown_ = now;
  scales_.publish(now);
}

/// What stands before the names of the insect's frames. False for a frame of no wing.
bool FlowView::learnPrefix(const std::string& frame) {
  for (const std::string wing : {frames::kRightWing, frames::kLeftWing}) {
    if (!endsWith(frame, wing)) continue;
    prefix_ = frame.substr(0, frame.size() - wing.size());
    return true;
  }
  return false;
}

void FlowView::publish(ros::Publisher& to, MarkerArray markers) const {
  for (Marker& marker : markers.markers) {
    if (marker.header.frame_id != frames::kWorldNed)
      marker.header.frame_id = prefix_ + marker.header.frame_id;
  }
  to.publish(markers);
}

}  // namespace monarch_flight
