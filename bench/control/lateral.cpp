// How well the lateral law holds a heading: whole turns, starts off the plane of symmetry, gusts
// from the side, a wing that has lost a part.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <sstream>

#include "control/study.h"
#include "monarch_flight/insect/gusts.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/trim/control_design.h"
#include "trim/case_edit.h"

namespace monarch_flight {
namespace {

/// Of some flaps of a flight.
struct Extent {
  double heading = 0.0;  ///< at the end, against the start [rad]
  double roll = 0.0, side = 0.0, speed = 0.0,
         climb = 0.0;  ///< largest distance from 0 or what is wanted
  std::size_t limited = 0;
};

Extent extentOf(const ControlledFlight& flight, const SetPoint& wanted, std::size_t from) {
  Extent e;
  for (std::size_t i = 0; i < flight.flaps.size(); ++i) {
    const ControlledFlap& flap = flight.flaps[i];
    e.heading += flap.turn;
    if (i < from) continue;
    e.roll = std::max({e.roll, flap.roll_high, -flap.roll_low});
    e.side = std::max(e.side, std::abs(flap.side_velocity));
    e.speed = std::max(e.speed, std::abs(flap.speed - wanted.speed));
    e.climb = std::max(e.climb, std::abs(flap.climb - wanted.climb));
    e.limited += flap.limited;
  }
  return e;
}

/// Flaps after which the heading stays within a degree of the one at the end of the way.
int arrived(const ControlledFlight& flight, double wanted, std::size_t from) {
  double heading = 0.0;
  int last = -1;
  for (std::size_t i = 0; i < flight.flaps.size(); ++i) {
    heading += flight.flaps[i].turn;
    if (std::abs(heading - wanted) > kDegree) last = static_cast<int>(i) + 1;
  }
  const bool there = last < static_cast<int>(flight.flaps.size());
  return there && !flight.lost ? std::max(last, 0) - static_cast<int>(from) : -1;
}

void print(const char* what, const Extent& e, int after, const ControlledFlight& flight) {
  std::printf(
      "%s: heading %.2f deg at the end, there after %d flaps; speed off by at most %.3f m/s, climb "
      "by %.2f deg; roll up to %.1f deg, side-slip %.3f m/s; inputs limited in %zu of %zu "
      "flaps%s\n",
      what, e.heading / kDegree, after, e.speed, e.climb / kDegree, e.roll / kDegree, e.side,
      e.limited, flight.flaps.size(), flight.lost ? ", LOST" : "");
  if (!flight.complete) std::printf("  the flight ended: %s\n", flight.failure.c_str());
}

void turn(Subject s, double heading) {
  constexpr int kBefore = 3;
  SetPoint to = s.wanted;
  to.flap = kBefore;
  to.heading = heading;
  s.law.set_points.push_back(to);
  ControlledStart start;
  start.flaps = kBefore + 20 + static_cast<int>(std::ceil(std::abs(heading) / s.law.lateral->turn));
  const ControlledFlight flight = s.fly(start);
  char what[60];
  std::snprintf(what, sizeof what, "turn of %.0f deg at %.1f deg a flap", heading / kDegree,
                s.law.lateral->turn / kDegree);
  print(what, extentOf(flight, s.wanted, kBefore), arrived(flight, heading, kBefore), flight);
}

/// Normal errors: in the plane as in `starts`, out of it 0.2 m/s, 8 deg, 2 rad/s, left wing as the
/// right one, times `size`.
void sides(const Subject& s, double size, int number) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  FlapState deviation;
  deviation << 0.2, 0.2, 8.0 * kDegree, 2.0, 8.0 * kDegree, 4.0, 0.2, 8.0 * kDegree, 2.0, 2.0,
      8.0 * kDegree, 4.0;
  int held = 0, lost = 0, alone = 0, slowest = 0;
  for (int i = 0; i < number; ++i) {
    ControlledStart start;
    start.flaps = 50;
    for (int k = 0; k < kFlapStates; ++k) start.change(k) = size * deviation(k) * normal(random);
    const ControlledFlight flight = s.fly(start);
    const int in_plane = settled(flight, s.wanted, 0), heading = arrived(flight, 0.0, 0);
    held += in_plane >= 0 && heading >= 0;
    slowest = std::max({slowest, in_plane, heading});
    lost += flight.lost || !flight.complete;
    start.uncontrolled = true;
    start.flaps = 20;
    const ControlledFlight free = s.fly(start);
    alone += settled(free, s.wanted, 0) >= 0 && arrived(free, 0.0, 0) >= 0;
  }
  std::printf(
      "sides: %.2f times the usual errors in all twelve states: %d of %d held (the slowest settles "
      "after %d flaps), %d lost; without control %d held\n",
      size, held, number, slowest, lost, alone);
}

/// Rises and falls as 1 - cos.
void crossGust(const Subject& s, double size, double flaps) {
  constexpr int kBefore = 3;
  const double T = s.c.time.period;
  for (double side : {1.0, -1.0}) {
    ControlledStart start;
    start.flaps = 40;
    start.wind = std::make_shared<TimeGust>(s.c.time.t_start + kBefore * T, flaps * T,
                                            size * Eigen::Vector3d(0.0, side, 0.0));
    const ControlledFlight flight = s.fly(start);
    char what[60];
    std::snprintf(what, sizeof what, "cross_gust: %.2f m/s for %.1f flaps to the %s", size, flaps,
                  side > 0.0 ? "right" : "left");
    print(what, extentOf(flight, s.wanted, 0), arrived(flight, 0.0, kBefore), flight);
  }
}

Case cut(const Case& c, double lost, const std::string& config_dir) {
  CaseEdit edit(c.resolved_yaml);
  edit.open({"insect", "left_wing"});
  edit.set({"insect", "left_wing", "tip_lost"}, lost);
  return caseFromText(edit.text(), c.name + " with a cut wing", {}, config_dir);
}

void flyCut(const Subject& s, double lost, bool uncontrolled, const char* law) {
  ControlledStart start;
  start.flaps = 60;
  start.uncontrolled = uncontrolled;
  const ControlledFlight flight = s.fly(start);
  char what[100];
  std::snprintf(what, sizeof what, "damage: %.0f %% of the left wing's area cut off, %s",
                100.0 * lost, law);
  print(what, extentOf(flight, s.wanted, 0), arrived(flight, 0.0, 0), flight);
  if (flight.flaps.empty()) return;
  const ControlledFlap& last = flight.flaps.back();
  std::printf("  last flap: %.3f m/s, climb %.2f deg, roll %.1f to %.1f deg;", last.speed,
              last.climb / kDegree, last.roll_low / kDegree, last.roll_high / kDegree);
  for (const CommandInfo& info : kCommandTable)
    if (last.command_high.*info.value != last.command_low.*info.value)
      std::printf(" %s %.4f to %.4f", info.name, last.command_low.*info.value,
                  last.command_high.*info.value);
  std::printf("\n");
}

/// A wing that loses more and more: the law of the whole insect on it, and one that has been made
/// for it, step by step from the one before.
void damage(const Subject& whole, const ControlOptions& given, const std::string& config_dir) {
  constexpr double kStep = 0.02, kMost = 0.21;
  constexpr double kDeviation = 0.35;  // limit of the difference of the wings' mean deviation [rad]
  ControlOptions options = given;
  options.limits[kDifferentialDeviation].low = -kDeviation;
  options.limits[kDifferentialDeviation].high = kDeviation;
  options.speeds = {whole.wanted.speed};
  options.climbs = {whole.wanted.climb};
  std::ostringstream log;
  for (int i = 1; i * kStep < kMost; ++i) {
    const double lost = i * kStep;
    Subject s = whole;
    s.c = cut(whole.c, lost, config_dir);
    s.wingbeat = wingbeatSettings(s.c, options);
    const bool told = i % 5 == 0 || i == 1;
    if (told) flyCut(s, lost, true, "without control");
    if (told) flyCut(s, lost, false, "with the law of the whole insect");
    try {
      const ControlDesign design = designController(s.c, options, log);
      options.guess = std::make_shared<ControlTrim>(design.trim);
      s.law = design.settings;
    } catch (const NumericalError& e) {
      std::printf("damage: %.0f %%: %s\n", 100.0 * lost, e.what());
      return;
    }
    if (told) flyCut(s, lost, false, "with a law of its own");
    std::printf("  trim:");
    for (const CommandInfo& info : kCommandTable)
      if (options.guess->wingbeat.command.*info.value != 0.0)
        std::printf(" %s %.4f", info.name, options.guess->wingbeat.command.*info.value);
    std::printf("\n");
  }
}

}  // namespace

void lateralStudy(const Subject& s, const std::string& what, const ControlOptions& options,
                  const std::string& config_dir) {
  if (!s.law.lateral) return;
  const auto takes = [&](const char* name) { return what.empty() || what == name; };
  if (takes("turn"))
    for (double heading : {90.0, 360.0, -360.0}) turn(s, heading * kDegree);
  if (takes("sides"))
    for (double size : {0.5, 1.0, 2.0}) sides(s, size, 20);
  if (takes("cross_gust")) crossGust(s, 0.5, 2.0);
  if (takes("damage")) damage(s, options, config_dir);
}

}  // namespace monarch_flight
