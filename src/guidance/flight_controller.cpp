#include "monarch_flight/guidance/flight_controller.h"

#include <algorithm>
#include <cmath>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

constexpr double kOnTime = 1e-6;  // of a sample: phases are sums of many steps

ControllerSettings checked(ControllerSettings settings) {
  const std::vector<std::string> faults = settings.problems();
  if (!faults.empty()) throw InputError(faults);
  return settings;
}

}  // namespace

FlightController::FlightController(ControllerSettings settings)
    : settings_(checked(std::move(settings))), law_(settings_.gains) {
  const auto n = static_cast<Eigen::Index>(settings_.states());
  if (settings_.lateral)
    lateral_.emplace(*settings_.lateral, settings_.samples, settings_.wing_pitch);
  now_.commands = ControlInput::Zero(law_.gains().size());
  now_.state = now_.next = deviation_ = ControlState::Zero(n);
  start();
}

void FlightController::start() {
  begun_ = false;
  index_ = 0.0;
  last_velocity_.setZero();
  velocity_sum_.setZero();
  wind_sum_.setZero();
  levels_ = 0.0;
  wind_mean_.setZero();
  reference_velocity_.setZero();
  orbit_velocity_.setZero();
  law_.start();
  if (lateral_) lateral_->start();
  limited_flaps_ = 0.0;
  lost_ = false;
}

std::optional<WingbeatChange> FlightController::next(const WingbeatLevel& level) {
  const HeadingMotion body = headingMotion(level.level.interface.body);
  const Air now = air(level.level, body);
  average(body, now);
  const double index = std::floor(level.phase * settings_.samples + kOnTime);
  if (begun_ && index == index_) return std::nullopt;
  sample(level, now, index);
  last_velocity_ = now.velocity;
  velocity_sum_.setZero();
  wind_sum_.setZero();
  levels_ = 0.0;
  index_ = index;
  begun_ = true;
  WingbeatChange wanted;
  law_.write(wanted);
  if (lateral_) lateral_->write(wanted);
  return wanted;
}

FlightController::Air FlightController::air(const GuidanceInput& level, const HeadingMotion& body) {
  const Eigen::Vector3d& v = body.velocity;
  const Eigen::Vector3d wind = inHeading(level.prescribed.wind.v, body.yaw.q);
  return {{v.x() - wind.x(), v.z() - wind.z()}, {wind.x(), wind.z()}, v.y() - wind.y()};
}

void FlightController::average(const HeadingMotion& body, const Air& now) {
  if (lateral_) lateral_->average(body, now.side_velocity);
  if (!begun_) return;
  velocity_sum_ += 0.5 * (last_velocity_ + now.velocity);
  wind_sum_ += now.wind;
  levels_ += 1.0;
  last_velocity_ = now.velocity;
}

void FlightController::sample(const WingbeatLevel& level, const Air& now, double index) {
  const double N = settings_.samples;
  const int phase = static_cast<int>(index - N * std::floor(index / N));
  const bool first = !begun_, prescribed = level.level.step <= settings_.first_step;
  if (first) {
    wind_mean_ = now.wind;
    reference_velocity_ = settings_.set_points.front().velocity() - wind_mean_;
  } else {
    wind_mean_ += (wind_sum_ / levels_ - wind_mean_) / N;
    moveReference(level.phase, (index - index_) / N);
  }
  const bool active = !first && !prescribed && !lost_;
  const bool is_limited = active && limited(level.command);
  limited_flaps_ = is_limited ? limited_flaps_ + (index - index_) / N : 0.0;
  if (active)
    law_.integrate(phase, (velocity_sum_ / levels_ - orbit_velocity_) / settings_.samples);
  settings_.table.at(reference_velocity_, phase, now_);
  orbit_velocity_ = now_.velocity;
  law_.refer(now_.commands);
  if (lateral_) {
    lateral_->move(phase, first ? 0.0 : (index - index_) / N, heading(level.phase), active);
    lateral_->refer();
  }
  if (!prescribed && !lost_) feedBack(level, now, phase);
}

std::optional<double> FlightController::heading(double flap) const {
  std::optional<double> wanted = settings_.set_points.front().heading;
  for (const SetPoint& point : settings_.set_points)
    if (point.heading && point.flap <= flap + kOnTime) wanted = point.heading;
  return wanted;
}

/// Towards the newest set point, seen through the air.
void FlightController::moveReference(double flap, double flaps) {
  const auto& points = settings_.set_points;
  const SetPoint* wanted = &points.front();
  for (const SetPoint& point : points)
    if (point.flap <= flap + kOnTime) wanted = &point;
  const Eigen::Vector2d way = wanted->velocity() - wind_mean_ - reference_velocity_;
  const double most = settings_.slew * flaps, length = way.norm();
  reference_velocity_ += length > most ? Eigen::Vector2d(way * (most / length)) : way;
}

/// Whether a command of the last sample was cut.
bool FlightController::limited(const WingbeatChange& taken) {
  const bool in_plane = law_.limited(taken);
  return (lateral_ && lateral_->limited(taken)) || in_plane;
}

void FlightController::feedBack(const WingbeatLevel& level, const Air& now, int phase) {
  const Interface& at = level.level.interface;
  deviation_.head<2>() = now.velocity;
  deviation_(2) = at.body.pitch.q;
  deviation_(3) = at.body.pitch.qd;
  if (settings_.wing_pitch) {
    const auto& [right, left] = at.theta;
    deviation_.tail<2>() << 0.5 * (right.q + left.q), 0.5 * (right.qd + left.qd);
  }
  deviation_ -= now_.state;
  lost_ = !deviation_.allFinite() || !(std::abs(deviation_(2)) <= settings_.lost_pitch) ||
          limited_flaps_ > settings_.lost_flaps;
  if (lost_) return;
  if (lateral_ && !lateral_->feedBack(phase, at, settings_.lost_pitch, level.applied)) {
    lost_ = true;
    return;
  }
  law_.feedBack(phase, deviation_, level.applied);
}

void FlightController::memory(StateVisitor& state) {
  state("controller_begun", begun_);
  state("controller_index", index_);
  state("controller_last_velocity", last_velocity_);
  state("controller_velocity_sum", velocity_sum_);
  state("controller_wind_sum", wind_sum_);
  state("controller_levels", levels_);
  state("controller_wind_mean", wind_mean_);
  state("controller_reference", reference_velocity_);
  state("controller_orbit_velocity", orbit_velocity_);
  law_.memory(state, "controller");
  if (lateral_) lateral_->memory(state);
  state("controller_limited_flaps", limited_flaps_);
  state("controller_lost", lost_);
}

}  // namespace monarch_flight
