#include "monarch_flight/run/wing_speeds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace monarch_flight {
namespace {

/// Points of the outline, wing axes. The speed of a rigid body is a convex function of the place,
/// so that it is largest on the outline, and there at the corners first of all.
std::vector<Eigen::Vector3d> outline(const Planform& wing) {
  constexpr int kStations = 32;
  std::vector<double> stations = wing.breaks();
  for (int i = 0; i <= kStations; ++i) {
    stations.push_back(wing.yRoot() + wing.span() * i / kStations);
  }
  std::vector<Eigen::Vector3d> points;
  for (const double y : stations) {
    points.emplace_back(wing.leading(y), y, 0.0);
    points.emplace_back(wing.trailing(y), y, 0.0);
  }
  return points;
}

double wholeRun(const TimeGrid& time) { return time.steps * time.dt; }

/// The air that a body meets at t [s].
using AirAt = std::function<Wind(double t, const BodyState& body)>;

/// Over `duration` from the start of the run.
WingSpeeds speedsThrough(const AirAt& air, const Case& c, double duration) {
  constexpr std::uint32_t kMost = 2000;
  const double steps = std::max(1.0, std::ceil(duration / c.time.dt * (1.0 - 1e-12)));
  const auto intervals = static_cast<std::uint32_t>(std::min<double>(kMost, steps));
  const Sides sides = c.sides();
  PerWing<std::vector<Eigen::Vector3d>> points;
  for (Side side : sides) points[side] = outline(c.insect.wings[side].planform);
  WingSpeeds peak;
  for (std::uint32_t i = 0; i <= intervals; ++i) {
    const double t = c.time.t_start + duration * i / intervals;
    const PrescribedState state = c.motion->at(t);
    const BodyState& body = state.body;
    for (Side side : sides) {
      const WingMotion wing = wingMotionInAir(side, c.insect, air(t, body), body, state.angles);
      const Eigen::Vector3d& root = wing.v_W;
      peak.root = std::max(peak.root, root.norm());
      peak.turn = std::max(peak.turn, wing.omega_W.norm());
      for (const Eigen::Vector3d& point : points[side])
        peak.outline = std::max(peak.outline, (root + wing.omega_W.cross(point)).norm());
    }
  }
  return peak;
}

}  // namespace

WingSpeeds peakWingSpeeds(const Case& c, double duration) {
  const WindRange wind = c.wind->range();
  const Wind middle{wind.middle, {0, 0, 0}};
  WingSpeeds peak = speedsThrough([&](double, const BodyState&) { return middle; }, c, duration);
  peak.root += wind.spread;
  peak.outline += wind.spread;
  return peak;
}

WingSpeeds peakWingSpeeds(const Case& c) {
  const double whole = wholeRun(c.time);
  WingSpeeds peak = peakWingSpeeds(c, whole);
  if (c.time.period > 0.0 && c.time.period < whole) {  // many flaps: few samples fall into each
    const WingSpeeds flap = peakWingSpeeds(c, c.time.period);
    peak = {std::max(peak.root, flap.root), std::max(peak.outline, flap.outline),
            std::max(peak.turn, flap.turn)};
  }
  return peak;
}

double referenceSpeed(const Case& c) {
  const double whole = wholeRun(c.time);
  const double duration = c.time.period > 0.0 ? std::min(c.time.period, whole) : whole;
  const auto met = [&c](double t, const BodyState& body) {
    return c.wind->at(t, body.x, body.v, body.a);
  };
  return speedsThrough(met, c, duration).outline;
}

double vortexThreshold(const Case& c) {
  return 0.1 * std::pow(referenceSpeed(c) / c.insect.meanChord(), 2);
}

}  // namespace monarch_flight
