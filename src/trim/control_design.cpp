#include "monarch_flight/trim/control_design.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/trim/trim.h"
#include "trim/control_gains.h"
#include "trim/control_scales.h"

namespace monarch_flight {
namespace {

using Eigen::Index;

/// Trims over a rectangle of speeds and climb angles, grown from the set point outwards.
class TableSearch {
 public:
  TableSearch(const PhaseMap& map, const ControlOptions& options, std::ostream& log)
      : map_(map), options_(options), log_(log) {}

  void grow(const ControlTrim& centre, std::vector<double> speeds, std::vector<double> climbs) {
    const int s0 = place(speeds, centre.speed), c0 = place(climbs, centre.climb);
    trims_[{s0, c0}] = centre;
    int low = s0, high = s0, down = c0, up = c0;
    while (low > 0 && reach(speeds, climbs, low - 1, c0, low, c0)) --low;
    while (high + 1 < int(speeds.size()) && reach(speeds, climbs, high + 1, c0, high, c0)) ++high;
    const auto row = [&](int k, int from) {
      for (int i = low; i <= high; ++i)
        if (!reach(speeds, climbs, i, k, i, from)) return false;
      return true;
    };
    while (down > 0 && row(down - 1, down)) --down;
    while (up + 1 < int(climbs.size()) && row(up + 1, up)) ++up;
    speeds_.assign(speeds.begin() + low, speeds.begin() + high + 1);
    climbs_.assign(climbs.begin() + down, climbs.begin() + up + 1);
    first_ = {low, down};
    centre_ = {s0, c0};
  }

  const ControlTrim& at(std::size_t i, std::size_t k) const {
    return trims_.at({first_.first + int(i), first_.second + int(k)});
  }
  const ControlTrim& centre() const { return trims_.at(centre_); }
  const std::vector<double>& speeds() const { return speeds_; }
  const std::vector<double>& climbs() const { return climbs_; }

 private:
  using Cell = std::pair<int, int>;

  /// The list is made to hold the value.
  static int place(std::vector<double>& list, double value) {
    constexpr double kSame = 1e-9;
    const auto near = std::find_if(list.begin(), list.end(),
                                   [&](double x) { return std::abs(x - value) < kSame; });
    if (near == list.end()) list.push_back(value);
    std::sort(list.begin(), list.end());
    return static_cast<int>(std::find_if(list.begin(), list.end(),
                                         [&](double x) { return std::abs(x - value) < kSame; }) -
                            list.begin());
  }

  bool reach(const std::vector<double>& speeds, const std::vector<double>& climbs, int i, int k,
             int from_i, int from_k) {
    const double speed = speeds[std::size_t(i)], climb = climbs[std::size_t(k)];
    log_ << "  " << speed << " m/s at " << climb / kDegree << " deg: " << std::flush;
    try {
      ControlTrim trim = findTrim(map_, options_, speed, climb, guess(i, k, from_i, from_k));
      for (std::size_t input : options_.inputs)
        log_ << kCommandTable[input].name << ' '
             << trim.wingbeat.command.*kCommandTable[input].value << ' ';
      log_ << "residual " << trim.residual << std::endl;
      trims_[{i, k}] = std::move(trim);
      return true;
    } catch (const NumericalError& e) {
      log_ << e.what() << std::endl;
      return false;
    }
  }

  /// On the straight line through the two neighbours in this direction.
  ControlTrim guess(int i, int k, int from_i, int from_k) const {
    ControlTrim near = trims_.at({from_i, from_k});
    const auto before = trims_.find({2 * from_i - i, 2 * from_k - k});
    if (before == trims_.end()) return near;
    near.start += near.start - before->second.start;
    std::vector<std::size_t> inputs = options_.inputs;
    if (!near.symmetric)
      inputs.insert(inputs.end(), options_.lateral_inputs.begin(), options_.lateral_inputs.end());
    for (std::size_t c : inputs) {
      double& value = near.wingbeat.command.*kCommandTable[c].value;
      const double step = value - before->second.wingbeat.command.*kCommandTable[c].value;
      value = std::clamp(value + step, options_.limits[c].low, options_.limits[c].high);
    }
    return near;
  }

  const PhaseMap& map_;
  const ControlOptions& options_;
  std::ostream& log_;
  std::map<Cell, ControlTrim> trims_;
  std::vector<double> speeds_, climbs_;
  Cell first_, centre_;
};

/// What both wings do alike.
Eigen::VectorXd inPlane(const FlapState& x, int n) {
  FlapState alike = x;
  alike.segment<2>(4) = 0.5 * (x.segment<2>(4) + x.tail<2>());
  return Eigen::VectorXd(alike).head(n);
}

/// The table of a controller; `moved`: the orbit that stands for the trim at the set point.
TrimTable tableOf(const TableSearch& search, const ControlOptions& options, int n,
                  const std::vector<FlapState>* moved) {
  const auto m = static_cast<Index>(options.inputs.size());
  const auto rows = static_cast<Index>(search.speeds().size() * search.climbs().size());
  Eigen::MatrixXd commands(rows, m), states(rows * options.samples, n);
  Index point = 0;
  for (std::size_t i = 0; i < search.speeds().size(); ++i) {
    for (std::size_t k = 0; k < search.climbs().size(); ++k, ++point) {
      const ControlTrim& trim = search.at(i, k);
      const WingbeatChange& centre = search.centre().wingbeat.command;
      for (Index c = 0; c < m; ++c) {
        const auto value = kCommandTable[options.inputs[std::size_t(c)]].value;
        commands(point, c) = trim.wingbeat.command.*value - (moved ? centre.*value : 0.0);
      }
      for (int j = 0; j < options.samples; ++j) {
        const auto s = static_cast<std::size_t>(j);
        FlapState x = trim.orbit[s];
        if (moved) x += (*moved)[s] - search.centre().orbit[s];
        states.row(point * options.samples + j) = inPlane(x, n).transpose();
      }
    }
  }
  return {search.speeds(), search.climbs(), commands, states};
}

std::vector<double> around(double middle, double step) {
  std::vector<double> list;
  for (int i = -2; i <= 2; ++i) list.push_back(middle + i * step);
  return list;
}

void checkCase(const Case& c, const ControlOptions& options) {
  std::vector<std::string> faults;
  if (!c.free[kX] || !c.free[kZ] || !c.free[kPitch])
    faults.push_back("free: x, z and pitch must be true for a flight to be controlled; free them");
  const int aside = (c.free[kY] ? 1 : 0) + (c.free[kRoll] ? 1 : 0) + (c.free[kYaw] ? 1 : 0);
  if (aside != 0 && aside != 3)
    faults.push_back("free: y, roll and yaw must all be true or all be false; change the others");
  if (aside == 0 && options.lateral_asked)
    faults.push_back(
        "lateral_inputs, turn: need y, roll and yaw free; give wings:=independent, or leave them "
        "out");
  if (options.inputs.size() < 2)
    faults.push_back(
        "inputs: must be two commands or more to hold speed and climb; amplitude,deviation_mean "
        "is usual");
  if (!faults.empty()) throw InputError(faults);
}

}  // namespace

ControlDesign designController(const Case& c, const ControlOptions& options, std::ostream& log) {
  checkCase(c, options);
  const PhaseMap map(c, options.samples, options.time_constant * c.time.period);
  const int n = controlStates(c);
  const SetPoint own = ownSetPoint(c);
  const double speed = options.speed.value_or(own.speed), climb = options.climb.value_or(own.climb);
  const bool turns = c.free[kY] && c.free[kRoll] && c.free[kYaw];
  ControlTrim start;
  start.start = map.prescribedState(0);
  if (options.guess) start = *options.guess;
  start.symmetric = !turns || fliesStraight(map);
  log << "periodic flights by constant commands:\n  " << speed << " m/s at " << climb / kDegree
      << " deg, the set point: " << std::flush;
  const ControlTrim centre = findTrim(map, options, speed, climb, start);
  log << "residual " << centre.residual << std::endl;
  TableSearch search(map, options, log);
  search.grow(centre, options.speeds.empty() ? around(speed, 0.15 * speed) : options.speeds,
              options.climbs.empty() ? around(climb, 10.0 * kDegree) : options.climbs);

  ControlDesign design;
  design.options = options;
  design.trim = centre;
  std::vector<FlapState> orbit = centre.orbit;
  if (options.own_orbit || options.own_gains)
    for (int j = 0; j < options.samples; ++j) orbit[std::size_t(j)] = map.prescribedState(j);
  const std::vector<FlapState>& about = options.own_gains ? orbit : centre.orbit;
  const WingbeatStart& wingbeat = options.own_gains ? WingbeatStart() : centre.wingbeat;
  const auto space = inPlaneSpace(c, options.inputs);
  design.in_plane = linearLaw(linearise(map, *space, about, wingbeat), *space, options);
  ControllerSettings& s = design.settings;
  s.samples = options.samples;
  s.gains = design.in_plane.gains;
  s.time_constant = options.time_constant;
  s.wing_pitch = c.free[kThetaR];
  s.table = tableOf(search, options, n, options.own_orbit ? &orbit : nullptr);
  if (turns) designLateral(design, map, centre, about, wingbeat);
  s.set_points = {{0.0, speed, climb}};
  s.slew = 0.1;
  s.lost_pitch = 75.0 * kDegree;
  s.lost_flaps = 10.0;
  design.residual = centre.residual;
  for (std::size_t i = 0; i < search.speeds().size(); ++i)
    for (std::size_t k = 0; k < search.climbs().size(); ++k)
      design.residual = std::max(design.residual, search.at(i, k).residual);
  return design;
}

}  // namespace monarch_flight
