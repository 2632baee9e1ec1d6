#pragma once
#include <gtest/gtest.h>

#include <algorithm>

#include "monarch_flight/guidance/flight_controller.h"

namespace monarch_flight {

inline constexpr std::size_t kAmplitude = 0, kDeviation = 3;

/// Two inputs, N samples, a table of one point: 1 m/s, level, no orbit but theta_B = 0.1 j.
inline ControllerSettings simple(int N = 4) {
  ControllerSettings s;
  s.samples = N;
  s.gains.inputs = {kAmplitude, kDeviation};
  s.time_constant = 0.1;
  s.wing_pitch = false;
  Eigen::MatrixXd commands(1, 2), states(N, 4);
  commands << 0.01, 0.02;
  for (int j = 0; j < N; ++j) states.row(j) << 1.0, 0.0, 0.1 * j, 0.0;
  s.table = {{1.0}, {0.0}, commands, states};
  s.gains.state = Eigen::MatrixXd::Zero(2 * N, 4);
  s.gains.filter = Eigen::MatrixXd::Zero(2 * N, 6);
  s.gains.integral = Eigen::MatrixXd::Zero(2 * N, 2);
  s.set_points = {{0.0, 1.0, 0.0}};
  s.slew = 0.1;
  s.lost_pitch = 1.0;
  s.lost_flaps = 3.0;
  return s;
}

/// Asks a controller level by level; commands are taken within +-limit.
struct Ride {
  explicit Ride(const ControllerSettings& settings) : controller(settings) {
    input.dt = 0.01;
    input.interface.body.v.x() = 1.0;
  }
  std::optional<WingbeatChange> ask(double phase) {
    ++input.step;
    const auto wanted = controller.next({input, phase, 10.0, input.dt, taken, applied});
    if (wanted) {
      taken = *wanted;
      for (const CommandInfo& info : kCommandTable)
        taken.*info.value = std::clamp(taken.*info.value, -limit, limit);
    }
    return wanted;
  }
  FlightController controller;
  GuidanceInput input;
  WingbeatChange taken;
  std::array<Coordinate, kCommands> applied{};
  double limit = 1e9;
};

}  // namespace monarch_flight
