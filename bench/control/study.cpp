// How well a controller holds in quasi-steady air: long flight, random starts, gusts, set points
// moved (docs/guidance.md). monarch study-control calls it.
#include "control/study.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <random>

#include "monarch_flight/insect/gusts.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/trim/command.h"

namespace monarch_flight {
namespace {

bool near(const ControlledFlap& flap, const SetPoint& wanted, double speed, double climb) {
  return std::abs(flap.speed - wanted.speed) <= speed &&
         std::abs(flap.climb - wanted.climb) <= climb;
}

}  // namespace

int settled(const ControlledFlight& flight, const SetPoint& wanted, std::size_t from) {
  if (!flight.complete || flight.lost) return -1;
  std::size_t last = flight.flaps.size();
  while (last > from && near(flight.flaps[last - 1], wanted, 0.05, kDegree)) --last;
  return last == flight.flaps.size() ? -1 : static_cast<int>(last - from);
}

namespace {

void hold(const Subject& s, int flaps) {
  ControlledStart start;
  start.flaps = flaps;
  const ControlledFlight flight = s.fly(start);
  double speed = 0.0, climb = 0.0, worst_speed = 0.0, worst_climb = 0.0, pitch = 0.0;
  double low = 1e9, high = -1e9;
  for (const ControlledFlap& flap : flight.flaps) {
    const double n = static_cast<double>(flight.flaps.size());
    speed += flap.speed / n;
    climb += flap.climb / n;
    pitch += flap.theta_B_mean / n;
    worst_speed = std::max(worst_speed, std::abs(flap.speed - s.wanted.speed));
    worst_climb = std::max(worst_climb, std::abs(flap.climb - s.wanted.climb));
    low = std::min(low, flap.theta_B_low);
    high = std::max(high, flap.theta_B_high);
  }
  std::printf(
      "hold: %zu flaps%s; mean %.4f m/s, %.3f deg (wanted %.4f, %.3f); worst flap off by %.4f m/s, "
      "%.3f deg; theta_B mean %.2f, within %.2f to %.2f deg\n",
      flight.flaps.size(), flight.lost ? ", LOST" : "", speed, climb / kDegree, s.wanted.speed,
      s.wanted.climb / kDegree, worst_speed, worst_climb / kDegree, pitch / kDegree, low / kDegree,
      high / kDegree);
}

/// Normal errors of the start: 0.2 m/s, 8 deg, 2 rad/s, wing 8 deg, 4 rad/s, times `size`.
void starts(const Subject& s, double size, int number) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  FlapState deviation;
  deviation << 0.2, 0.2, 8.0 * kDegree, 2.0, 8.0 * kDegree, 4.0;
  int held = 0, lost = 0, limited = 0, alone = 0, slowest = 0;
  for (int i = 0; i < number; ++i) {
    ControlledStart start;
    start.flaps = 40;
    for (int k = 0; k < 6; ++k) start.change(k) = size * deviation(k) * normal(random);
    const ControlledFlight flight = s.fly(start);
    const int after = settled(flight, s.wanted, 0);
    const bool cut = std::any_of(flight.flaps.begin(), flight.flaps.end(),
                                 [](const ControlledFlap& flap) { return flap.limited; });
    held += after >= 0;
    slowest = std::max(slowest, after);
    lost += flight.lost;
    limited += cut;
    start.flaps = 20;
    start.uncontrolled = true;
    alone += settled(s.fly(start), s.wanted, 0) >= 0;
  }
  std::printf(
      "starts: %.2f times the usual errors: %d of %d held (the slowest settles after %d flaps), %d "
      "lost, inputs limited in %d; without control %d held\n",
      size, held, number, slowest, lost, limited, alone);
}

/// Rises and falls as 1 - cos.
void gust(const Subject& s, double size, double flaps) {
  constexpr int kBefore = 3;
  const double T = s.c.time.period;
  const std::pair<const char*, Eigen::Vector3d> sides[] = {{"from behind", {1, 0, 0}},
                                                           {"head on", {-1, 0, 0}},
                                                           {"downwards", {0, 0, 1}},
                                                           {"upwards", {0, 0, -1}}};
  for (const auto& [name, direction] : sides) {
    ControlledStart start;
    start.flaps = 50;
    start.wind =
        std::make_shared<TimeGust>(s.c.time.t_start + kBefore * T, flaps * T, size * direction);
    const ControlledFlight flight = s.fly(start);
    double speed = 0.0, climb = 0.0, pitch = 0.0;
    bool cut = false;
    for (const ControlledFlap& flap : flight.flaps) {
      speed = std::max(speed, std::abs(flap.speed - s.wanted.speed));
      climb = std::max(climb, std::abs(flap.climb - s.wanted.climb));
      pitch = std::max({pitch, flap.theta_B_high, -flap.theta_B_low});
      cut = cut || flap.limited;
    }
    std::printf(
        "gust: %.2f m/s for %.1f flaps, %s: off by at most %.3f m/s and %.2f deg, |theta_B| up to "
        "%.1f deg; back %d flaps after it began%s%s\n",
        size, flaps, name, speed, climb / kDegree, pitch / kDegree,
        settled(flight, s.wanted, kBefore), cut ? ", inputs limited" : "",
        flight.lost ? ", LOST" : "");
  }
}

void step(Subject s, double speed, double climb) {
  constexpr int kBefore = 3;
  const SetPoint from = s.law.set_points.front();
  const SetPoint to{kBefore, speed, climb};
  s.law.set_points = {from, to};
  ControlledStart start;
  start.flaps = 80;
  const ControlledFlight flight = s.fly(start);
  const Eigen::Vector2d way = to.velocity() - from.velocity();
  int rise = -1;
  double over = 0.0, low = 1e9, high = -1e9;
  bool cut = false;
  for (std::size_t i = kBefore; i < flight.flaps.size(); ++i) {
    const ControlledFlap& flap = flight.flaps[i];
    const Eigen::Vector2d v = SetPoint{0.0, flap.speed, flap.climb}.velocity();
    const double part = (v - from.velocity()).dot(way) / way.squaredNorm();
    if (rise < 0 && part >= 0.9) rise = static_cast<int>(i) + 1 - kBefore;
    over = std::max(over, part - 1.0);
    low = std::min(low, flap.theta_B_low);
    high = std::max(high, flap.theta_B_high);
    cut = cut || flap.limited;
  }
  std::printf(
      "set point: %.3f m/s, %.2f deg to %.3f m/s, %.2f deg: 90 %% of the way after %d flaps, over "
      "it "
      "by %.1f %%, within 0.05 m/s and 1 deg after %d; theta_B %.1f to %.1f deg%s%s\n",
      from.speed, from.climb / kDegree, speed, climb / kDegree, rise, 100.0 * over,
      settled(flight, to, kBefore), low / kDegree, high / kDegree, cut ? ", inputs limited" : "",
      flight.lost ? ", LOST" : "");
}

Subject subjectOf(TrimCommand command, const std::string& config_dir) {
  command.overrides["fluid"] = "quasi_steady";
  command.control->limits = ControlOptions::usualLimits(config_dir);
  Subject s{loadCase(command.case_name, command.overrides, config_dir), {}, {}, {}};
  if (s.c.guidance.controller) {
    s.wingbeat = s.c.guidance.wingbeat;
    s.law = *s.c.guidance.controller;
    s.law.first_step = 0;
  } else {
    const ControlDesign design = designController(s.c, *command.control, std::cout);
    s.wingbeat = wingbeatSettings(s.c, *command.control);
    s.law = design.settings;
  }
  s.wanted = s.law.set_points.front();
  return s;
}

void study(const Subject& s, const std::string& what, int flaps) {
  const auto takes = [&](const char* name) { return what.empty() || what == name; };
  if (takes("hold")) hold(s, flaps);
  if (takes("starts"))
    for (double size : {0.5, 1.0, 2.0, 3.0}) starts(s, size, 20);
  if (takes("gust")) gust(s, 0.5, 2.0);
  if (!takes("steps")) return;
  for (double climb : {10.0, 40.0}) step(s, s.wanted.speed, climb * kDegree);
  for (double speed : {1.0, 1.8}) step(s, speed, s.wanted.climb);
}

const std::vector<std::string> kStudies = {"hold", "starts", "gust", "steps"};

int run(std::vector<std::string> arguments, const std::string& config_dir) {
  std::string what;
  const auto own = std::find_if(arguments.begin(), arguments.end(),
                                [](const std::string& a) { return a.rfind("study:=", 0) == 0; });
  if (own != arguments.end()) {
    what = own->substr(7);
    arguments.erase(own);
    std::string known;
    for (const auto* names : {&kStudies, &kLateralStudies})
      for (const std::string& name : *names) known += (known.empty() ? "" : ", ") + name;
    if ((", " + known + ",").find(", " + what + ",") == std::string::npos)
      throw InputError("study:=" + what + ": must be one of " + known + "; choose one");
  }
  arguments.push_back("control:=true");
  TrimCommand command = trimCommand(arguments);
  const int flaps = command.fly > 0 ? command.fly : 200;
  ControlOptions options = *command.control;
  options.limits = ControlOptions::usualLimits(config_dir);
  const Subject subject = subjectOf(std::move(command), config_dir);
  study(subject, what, flaps);
  lateralStudy(subject, what, options, config_dir);
  return 0;
}

}  // namespace
}  // namespace monarch_flight

int main(int argc, char** argv) {
  try {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    return monarch_flight::run({argv + 1, argv + argc}, CONFIG_DIR);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "study_control: %s\n", e.what());
    return 2;
  }
}
