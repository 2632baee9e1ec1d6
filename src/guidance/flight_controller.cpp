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
    : settings_(checked(std::move(settings))) {
  const auto n = static_cast<Eigen::Index>(settings_.states());
  const auto m = static_cast<Eigen::Index>(settings_.inputs.size());
  now_.commands = asked_ = excess_ = ControlInput::Zero(m);
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
  integral_.setZero();
  asked_.setZero();
  excess_.setZero();
  limited_flaps_ = 0.0;
  lost_ = false;
}

std::optional<WingbeatChange> FlightController::next(const WingbeatLevel& level) {
  const Air now = air(level.level);
  average(now);
  const double index = std::floor(level.phase * settings_.samples + kOnTime);
  if (begun_ && index == index_) return std::nullopt;
  sample(level, now, index);
  last_velocity_ = now.velocity;
  velocity_sum_.setZero();
  wind_sum_.setZero();
  levels_ = 0.0;
  index_ = index;
  begun_ = true;
  return change();
}

FlightController::Air FlightController::air(const GuidanceInput& level) const {
  const Eigen::Vector3d& v = level.interface.body.v;
  const Eigen::Vector3d& wind = level.prescribed.wind.v;
  return {{v.x() - wind.x(), v.z() - wind.z()}, {wind.x(), wind.z()}};
}

void FlightController::average(const Air& now) {
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
  if (active) integrate(phase);
  settings_.table.at(reference_velocity_, phase, now_);
  orbit_velocity_ = now_.velocity;
  asked_ = now_.commands;
  if (!prescribed && !lost_) feedBack(level, now, phase);
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

/// Whether the command of the last sample was cut, and by how much.
bool FlightController::limited(const WingbeatChange& taken) {
  for (std::size_t i = 0; i < settings_.inputs.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    excess_(k) = asked_(k) - taken.*kCommandTable[settings_.inputs[i]].value;
  }
  return (excess_.array() != 0.0).any();
}

/// Adds the last sample's mean, unless it would drive a limited input further.
void FlightController::integrate(int phase) {
  const Eigen::Vector2d step = (velocity_sum_ / levels_ - orbit_velocity_) / settings_.samples;
  const Eigen::Index m = asked_.size();
  const auto gain = settings_.integral_gain.middleRows(phase * m, m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const double drive = -(gain(i, 0) * step.x() + gain(i, 1) * step.y());
    if (drive * excess_(i) > 0.0) return;
  }
  integral_ += step;
}

void FlightController::feedBack(const WingbeatLevel& level, const Air& now, int phase) {
  const Interface& at = level.level.interface;
  deviation_.head<2>() = now.velocity;
  deviation_(2) = at.body.pitch.q;
  deviation_(3) = at.body.pitch.qd;
  if (settings_.wing_pitch) deviation_.tail<2>() << at.theta.right.q, at.theta.right.qd;
  deviation_ -= now_.state;
  lost_ = !deviation_.allFinite() || !(std::abs(deviation_(2)) <= settings_.lost_pitch) ||
          limited_flaps_ > settings_.lost_flaps;
  if (lost_) return;
  const Eigen::Index m = asked_.size();
  asked_.noalias() -= settings_.state_gain.middleRows(phase * m, m) * deviation_;
  asked_.noalias() -= settings_.integral_gain.middleRows(phase * m, m) * integral_;
  const auto gain = settings_.filter_gain.middleRows(phase * m, m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Coordinate& c = level.applied[settings_.inputs[static_cast<std::size_t>(i)]];
    asked_ -= gain.col(3 * i) * (c.q - now_.commands(i)) + gain.col(3 * i + 1) * c.qd +
              gain.col(3 * i + 2) * c.qdd;
  }
}

WingbeatChange FlightController::change() const {
  WingbeatChange wanted;
  for (std::size_t i = 0; i < settings_.inputs.size(); ++i)
    wanted.*kCommandTable[settings_.inputs[i]].value = asked_(static_cast<Eigen::Index>(i));
  return wanted;
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
  state("controller_integral", integral_);
  state("controller_asked", asked_);
  state("controller_limited_flaps", limited_flaps_);
  state("controller_lost", lost_);
}

}  // namespace monarch_flight
