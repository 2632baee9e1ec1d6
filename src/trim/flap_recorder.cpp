#include "trim/flap_recorder.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "monarch_flight/insect/heading.h"
#include "monarch_flight/math/seconds_since.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/trim/periodic_shape.h"

namespace monarch_flight {
namespace {

double swing(const std::vector<double>& q, std::size_t first, std::size_t last) {
  const auto [low, high] = std::minmax_element(q.begin() + static_cast<std::ptrdiff_t>(first),
                                               q.begin() + static_cast<std::ptrdiff_t>(last));
  return *high - *low;
}

}  // namespace

FlapRecorder::FlapRecorder(const TimeGrid& time, std::uint32_t run_in_steps, int harmonics)
    : time_(time), run_in_(run_in_steps), harmonics_(harmonics) {}

void FlapRecorder::onStep(const CommittedStep& step) {
  const BodyState& body = step.interface.body;
  states_.push_back(flapState(step.interface));
  accelerations_.push_back(flapRates(step.interface));
  sideways_.push_back(body.x.y());
  heading_.push_back(headingMotion(body).yaw.q);
  q_[0].push_back(body.x.x());
  q_[1].push_back(body.x.z());
  q_[2].push_back(body.pitch.q);
  q_[3].push_back(step.interface.theta.right.q);
}

void FlapRecorder::onReset() {
  states_.clear();
  accelerations_.clear();
  sideways_.clear();
  heading_.clear();
  for (std::vector<double>& samples : q_) samples.clear();
}

Flap FlapRecorder::flap(std::size_t first, std::size_t last) const {
  Flap f;
  f.start = states_[first];
  f.end = states_[last];
  const double vx = (q_[0][last] - q_[0][first]) / time_.period;
  const double vy = (sideways_[last] - sideways_[first]) / time_.period;
  const double vz = (q_[1][last] - q_[1][first]) / time_.period;
  f.speed = std::hypot(vx, vy, vz);
  f.climb = std::atan2(-vz, vy == 0.0 ? vx : std::hypot(vx, vy));
  for (std::size_t k = first; k < last; ++k)
    f.turn += std::remainder(heading_[k + 1] - heading_[k], 2.0 * M_PI);
  f.theta_B_swing = swing(q_[2], first, last);
  f.theta_R_swing = swing(q_[3], first, last);
  std::array<std::vector<double>, 4> samples;
  for (std::size_t k = first; k <= last; ++k) {
    for (std::size_t i = 0; i < 4; ++i) samples[i].push_back(q_[i][k]);
    f.theta_B_largest = std::max(f.theta_B_largest, std::abs(q_[2][k]));
    if (k < last) f.theta_B_mean += q_[2][k] / static_cast<double>(last - first);
  }
  f.shape = flapShape(samples, time_, harmonics_);
  return f;
}

std::vector<Flap> FlapRecorder::flaps() const {
  const auto per_flap = static_cast<std::size_t>(std::lround(time_.stepsPerFlap()));
  std::vector<Flap> all;
  for (std::size_t k = run_in_; k + per_flap < states_.size(); k += per_flap) {
    all.push_back(flap(k, k + per_flap));
  }
  return all;
}

FlapShape flapShape(const std::array<std::vector<double>, 4>& samples, const TimeGrid& time,
                    int harmonics) {
  const auto series = [&](std::size_t i) {
    return periodicSeries(samples[i], time.period, time.t_start, harmonics);
  };
  FlapShape shape{series(0), series(1), series(2), series(3)};
  shape.x.a0 = shape.z.a0 = 0.0;  // where the flap began does not matter
  return shape;
}

Flight flyCase(Case c, FlapRecorder& recorder) {
  c.output.surface_every = c.output.flow_every = 0;
  const auto begin = std::chrono::steady_clock::now();
  const StopFlag stop{false};
  InProcessFederation federation(c);
  const RunResult result = federation.run(1, {&recorder}, stop);
  Flight flight;
  flight.complete = result.complete;
  flight.failure = result.failure;
  flight.flaps = recorder.flaps();
  flight.wall_s = secondsSince(begin);
  return flight;
}

}  // namespace monarch_flight
