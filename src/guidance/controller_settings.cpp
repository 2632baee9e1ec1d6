#include "monarch_flight/guidance/controller_settings.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace monarch_flight {
namespace {

using Eigen::Index;

/// Place of a value in an ascending list: point below it and the part of the way to the next.
struct Place {
  Index below = 0, above = 0;
  double part = 0.0;
};

Place placeOf(double value, const std::vector<double>& points) {
  if (points.size() < 2 || value <= points.front()) return {};
  const auto last = static_cast<Index>(points.size()) - 1;
  if (!(value < points.back())) return {last, last, 0.0};  // not a number, too
  const auto above = std::upper_bound(points.begin(), points.end(), value) - points.begin();
  const double low = points[static_cast<std::size_t>(above - 1)];
  return {above - 1, above, (value - low) / (points[static_cast<std::size_t>(above)] - low)};
}

bool ascending(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(),
                            [](double a, double b) { return !(a < b); }) == values.end();
}

class Problems {
 public:
  void add(const std::string& key, const std::string& bound) {
    list.push_back("guidance/controller/" + key + ": must " + bound);
  }
  void shape(const std::string& key, const Eigen::MatrixXd& m, Index rows, Index columns) {
    if (m.rows() == rows && m.cols() == columns && m.allFinite()) return;
    add(key + " has " + std::to_string(m.rows()) + " rows of " + std::to_string(m.cols()),
        "be " + std::to_string(rows) + " rows of " + std::to_string(columns) +
            " finite numbers; let monarch trim write them (control:=true)");
  }
  void positive(const std::string& key, double value, const std::string& remedy) {
    if (std::isfinite(value) && value > 0.0) return;
    std::ostringstream text;
    text << key << " = " << value;
    add(text.str(), "be > 0; " + remedy);
  }
  std::vector<std::string> list;
};

void checkInputs(const std::vector<std::size_t>& inputs, std::size_t first, std::size_t last,
                 const std::string& section, const std::string& example, Problems& problems) {
  const std::set<std::size_t> different(inputs.begin(), inputs.end());
  if (inputs.empty() || different.size() != inputs.size() || *different.begin() < first ||
      *different.rbegin() >= last)
    problems.add(section + "inputs",
                 "be different commands of its own, at least one; as " + example);
}

void checkGains(const FeedbackGains& gains, int samples, int states, const std::string& section,
                Problems& problems) {
  const Index m = gains.size(), rows = m * samples;
  problems.shape(section + "gains/state", gains.state, rows, states);
  problems.shape(section + "gains/filter", gains.filter, rows, 3 * m);
  problems.shape(section + "gains/integral", gains.integral, rows, 2);
}

void checkLateral(const LateralSettings& lateral, int samples, int states, Problems& problems) {
  checkInputs(lateral.gains.inputs, kAlikeCommands, kCommands, "lateral/",
              "differential_deviation, differential_rest_angle", problems);
  checkGains(lateral.gains, samples, states, "lateral/", problems);
  problems.shape("lateral/turn/commands", lateral.turn_commands, lateral.gains.size(), 1);
  problems.shape("lateral/turn/states", lateral.turn_states, samples, states);
  problems.shape("lateral/straight/commands", lateral.commands, lateral.gains.size(), 1);
  problems.shape("lateral/straight/states", lateral.states, samples, states);
  problems.positive("lateral/turn/most_deg", lateral.turn, "5 deg a flap is usual");
}

void checkSetPoints(const std::vector<SetPoint>& points, Problems& problems) {
  if (points.empty()) problems.add("set_points", "hold at least one set point; give one");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string key = "set_points[" + std::to_string(i) + "]";
    problems.positive(key + " speed", points[i].speed, "give the speed over ground in m/s");
    if (!std::isfinite(points[i].climb) || !(std::abs(points[i].climb) < 0.5 * M_PI))
      problems.add(key + " climb", "be between -90 and 90 deg; correct it");
    if (points[i].heading && !std::isfinite(*points[i].heading))
      problems.add(key + " heading", "be a number; correct it");
    if (!std::isfinite(points[i].flap) || (i > 0 && !(points[i - 1].flap < points[i].flap)))
      problems.add(key + " flap", "be a number above that of the set point before; sort them");
  }
}

}  // namespace

TrimTable::TrimTable(std::vector<double> speeds, std::vector<double> climbs,
                     Eigen::MatrixXd commands, Eigen::MatrixXd states)
    : speeds_(std::move(speeds)),
      climbs_(std::move(climbs)),
      commands_(std::move(commands)),
      states_(std::move(states)) {
  const Index points = commands_.rows();
  samples_ = points > 0 ? static_cast<int>(states_.rows() / points) : 0;
  means_ = Eigen::MatrixXd::Zero(points, 2);
  if (samples_ == 0 || states_.cols() < 2) return;
  for (Index i = 0; i < points; ++i)
    means_.row(i) = states_.block(i * samples_, 0, samples_, 2).colwise().mean();
}

/// Between points the mean of the interpolated orbit is not quite the velocity asked for: it is
/// moved there.
void TrimTable::at(const Eigen::Vector2d& velocity, int phase, TrimReference& r) const {
  const double norm = velocity.norm(), angle = std::atan2(-velocity.y(), velocity.x());
  const Place speed = placeOf(norm, speeds_), climb = placeOf(angle, climbs_);
  const auto width = static_cast<Index>(climbs_.size());
  r.commands.setZero();
  r.state.setZero();
  r.next.setZero();
  Eigen::Vector2d sampled = Eigen::Vector2d::Zero(), mean = sampled;
  for (int corner = 0; corner < 4; ++corner) {
    const Index i = corner < 2 ? speed.below : speed.above;
    const Index k = corner % 2 == 0 ? climb.below : climb.above;
    const double weight = (corner < 2 ? 1.0 - speed.part : speed.part) *
                          (corner % 2 == 0 ? 1.0 - climb.part : climb.part);
    const Index point = i * width + k, row = point * samples_;
    r.commands += weight * commands_.row(point).transpose();
    r.state += weight * states_.row(row + phase).transpose();
    r.next += weight * states_.row(row + (phase + 1) % samples_).transpose();
    sampled += weight * means_.row(point).transpose();
    mean += weight * SetPoint{0.0, speeds_[static_cast<std::size_t>(i)],
                              climbs_[static_cast<std::size_t>(k)]}
                         .velocity();
  }
  const SetPoint within{0.0, std::clamp(norm, speeds_.front(), speeds_.back()),
                        std::clamp(angle, climbs_.front(), climbs_.back())};
  r.velocity = within.velocity() + 0.5 * (r.state + r.next).head<2>() - sampled;
  r.state.head<2>() += within.velocity() - mean;
  r.next.head<2>() += within.velocity() - mean;
}

Eigen::Vector2d SetPoint::velocity() const {
  return {speed * std::cos(climb), -speed * std::sin(climb)};
}

std::vector<std::string> ControllerSettings::problems() const {
  Problems problems;
  if (samples < 1) {
    problems.add("samples = " + std::to_string(samples), "be >= 1 a flap; 10 is usual");
    return problems.list;
  }
  checkInputs(gains.inputs, 0, kAlikeCommands, "", "amplitude, deviation_mean", problems);
  if (table.speeds().empty() || !ascending(table.speeds()) || !(table.speeds().front() > 0.0))
    problems.add("table/speeds", "be > 0 and ascend; sort them");
  if (table.climbs().empty() || !ascending(table.climbs()))
    problems.add("table/climbs_deg", "ascend, at least one; sort them");
  const Index m = gains.size();
  const auto points = static_cast<Index>(table.speeds().size() * table.climbs().size());
  problems.shape("table/commands", table.commands(), points, m);
  problems.shape("table/states", table.states(), points * samples, states());
  checkGains(gains, samples, states(), "", problems);
  if (lateral) checkLateral(*lateral, samples, lateralStates(), problems);
  checkSetPoints(set_points, problems);
  problems.positive("time_constant", time_constant, "it is that of guidance/time_constant");
  problems.positive("slew", slew, "0.1 m/s a flap is usual");
  problems.positive("lost/pitch_deg", lost_pitch, "75 is usual");
  problems.positive("lost/flaps", lost_flaps, "10 is usual");
  return problems.list;
}

}  // namespace monarch_flight
