#include "monarch_flight/run/summary.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "monarch_flight/fluid/instruction_set.h"
#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/seconds_since.h"
#include "monarch_flight/run/pressure_reference.h"
#include "monarch_flight/run/remarks.h"

namespace monarch_flight {
namespace {

constexpr double kTumbled = 60.0 * kDegree;  // pitch of the body [rad]

using Json = nlohmann::ordered_json;

Json degrees(const Range& range) {
  return {
      {"min", range.min / kDegree}, {"mean", range.mean() / kDegree}, {"max", range.max / kDegree}};
}

Json matrix(const Matrix6d& M) {
  Json rows = Json::array();
  for (int i = 0; i < 6; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 6; ++j) row.push_back(M(i, j));
    rows.push_back(row);
  }
  return rows;
}

/// By kernel, and what is left of the fluid's time: set-up, pictures, fields.
Json kernels(const KernelTimes& times, double fluid) {
  Json j;
  double rest = fluid;
  for (std::size_t i = 0; i < kKernels; ++i) {
    j[kKernelNames[i]] = times[i];
    rest -= times[i];
  }
  j["rest"] = rest;
  return j;
}

}  // namespace

void Range::add(double value) {
  min = count ? std::min(min, value) : value;
  max = count ? std::max(max, value) : value;
  sum += value;
  ++count;
}

Summary::Summary(const Case& c)
    : case_(c),
      time_(c.time),
      begin_(std::chrono::steady_clock::now()),
      mid_plane_(c),
      hash_(c.mirrored) {}

void Summary::add(const CommittedStep& step) {
  const BodyState& body = step.interface.body;
  theta_B_.add(body.pitch.q);
  theta_R_.add(step.interface.theta.right.q);
  theta_L_.add(step.interface.theta.left.q);
  const double roll = rollPitchYaw(body.R_IB()).x();
  roll_.add(roll);
  const bool over = (case_.free[kPitch] && std::abs(body.pitch.q) > kTumbled) ||
                    (case_.free[kRoll] && std::abs(roll) > kTumbled);
  if (over && tumbled_ == kNever) tumbled_ = step.step;
  guidance_ = step.guidance;
  if (guidance_.lost && lost_ == kNever) lost_ = step.step;
  mid_plane_.add(step);
  hash_.add(step);
  addTimes(step);
  ignored_ = step.ignored;
  if (step.step == 0) {
    t_first_ = t_last_ = step.t;
    x_first_ = x_last_ = body.x;
    cells_ = step.fluid.cells;
    added_mass_ = step.fluid.added_mass;
    return;
  }
  steps_ = step.step;
  const double iterations = static_cast<double>(step.iterations.size());
  all_.add(iterations);
  if (!step.prescribed) {
    solved_.add(iterations);
    evaluations_.add(step.fluid_evaluations);
    retried_ += step.retried() ? 1 : 0;
    addWork(step);
  }
  ratio_.add(step.added_mass_ratio);
  const auto whole = static_cast<std::uint64_t>(std::floor(flaps() + 1e-9));
  if (whole > whole_flaps_ || whole == 0) {
    t_last_ = step.t;
    x_last_ = body.x;
  }
  whole_flaps_ = whole;
}

void Summary::addWork(const CommittedStep& step) {
  work_fluid_ += step.work_fluid;
  work_structure_ += step.work_structure;
  work_error_ = std::max(work_error_, std::abs(step.work_fluid - step.work_structure));
  work_scale_ = std::max(work_scale_, std::abs(step.work_fluid));
}

void Summary::addTimes(const CommittedStep& step) {
  for (std::size_t i = 0; i < wall_.size(); ++i) wall_[i] += step.wall_s[i];
  exchange_ += step.exchange_s;
  coupling_ += step.coupling_s;
  outputs_ = outputs_before_ + step.outputs_s;
  for (std::size_t i = 0; i < kernels_.size(); ++i)
    kernels_[i] = kernels_before_[i] + step.fluid.kernel_s[i];
}

double Summary::flaps() const {
  return time_.period > 0.0 ? steps_ * time_.dt / time_.period : 0.0;
}

Eigen::Vector3d Summary::meanVelocity() const {
  if (t_last_ <= t_first_) return Eigen::Vector3d::Zero();
  return (x_last_ - x_first_) / (t_last_ - t_first_);
}

double Summary::climbAngleDegrees() const {
  const Eigen::Vector3d v = meanVelocity();
  return std::atan2(0.0 - v.z(), std::hypot(v.x(), v.y())) / kDegree;
}

const Range& Summary::subIterations() const { return solved_.count ? solved_ : all_; }

double Summary::wallSeconds() const { return wall_before_ + secondsSince(begin_); }

void Summary::memory(StateVisitor& state) {
  const auto range = [&state](const std::string& name, Range& r) {
    state((name + "_min").c_str(), r.min);
    state((name + "_max").c_str(), r.max);
    state((name + "_sum").c_str(), r.sum);
    state((name + "_count").c_str(), r.count);
  };
  range("theta_B", theta_B_);
  range("roll", roll_);
  range("theta_R", theta_R_);
  range("theta_L", theta_L_);
  range("sub_iterations_solved", solved_);
  range("sub_iterations_all", all_);
  range("fluid_evaluations", evaluations_);
  range("added_mass_ratio", ratio_);
  state("steps", steps_);
  state("steps_retried", retried_);
  state("whole_flaps", whole_flaps_);
  state("tumbled", tumbled_);
  state("guidance_clipped", guidance_.clipped);
  state("guidance_refused", guidance_.refused);
  state("guidance_lost_at", lost_);
  state("t_first", t_first_);
  state("t_last", t_last_);
  state("x_first", x_first_);
  state("x_last", x_last_);
  state("work_fluid", work_fluid_);
  state("work_structure", work_structure_);
  state("work_error", work_error_);
  state("work_scale", work_scale_);
  state.numbers("wall_s", wall_.data(), wall_.size());
  state("wall_s_exchange", exchange_);
  state("wall_s_coupling", coupling_);
  state("wall_s_outputs", outputs_);
  state.numbers("wall_s_kernels", kernels_.data(), kernels_.size());
  if (state.loading()) {
    outputs_before_ = outputs_;
    kernels_before_ = kernels_;
  }
  state("cells", cells_);
  state("added_mass", added_mass_);
  mid_plane_.memory(state);
  hash_.memory(state);
  double wall = wallSeconds();
  state("wall_s_total", wall);
  if (state.loading()) wall_before_ = wall;
  state("resumed", resumed_);
}

void Summary::resume(StateVisitor& state, const Resumption& resumption) {
  memory(state);
  Json all = Json::parse(resumed_);
  all.push_back({{"step", resumption.step},
                 {"changed", resumption.changed},
                 {"refused", resumption.refused}});
  resumed_ = all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Flap of a step, counted from 1; 0 without a period. A flap's last step belongs to it.
std::uint64_t Summary::flapOf(std::uint32_t step) const {
  if (!(time_.period > 0.0)) return 0;
  const double flaps = step * time_.dt / time_.period;
  return std::max(1L, std::lround(std::ceil(flaps * (1.0 - 1e-9))));
}

std::vector<std::string> Summary::remarks() const {
  std::vector<std::string> remarks = runRemarks(case_, steps_);
  const std::string meet = mid_plane_.remark();
  if (!meet.empty()) remarks.push_back(meet);
  return remarks;
}

std::string Summary::json(const std::string& failure) const {
  Json j;
  j["status"] = failure.empty() ? "complete" : "failed";
  j["failure"] = failure;
  j["case"] = case_.name;
  j["case_sha256"] = case_.sha256;
  j["version"] = MONARCH_FLIGHT_VERSION;
  j["instruction_set"] = fluidInstructionSet();
  j["fluid"] = fluidName(case_);
  j["steps"] = steps_;
  j["flaps"] = flaps();
  j["free_steps"] = solved_.count;
  j["remarks"] = failure.empty() ? remarks() : std::vector<std::string>();
  const bool tumbled = tumbled_ != kNever;
  j["tumbled_from_step"] = tumbled ? Json(tumbled_) : Json();
  j["tumbled_from_flap"] = tumbled && flapOf(tumbled_) > 0 ? Json(flapOf(tumbled_)) : Json();
  j["sub_iterations"] = {{"mean", subIterations().mean()},
                         {"max", std::lround(subIterations().max)}};
  j["retried_steps"] = retried_;
  j["fluid_evaluations"] = {{"mean", evaluations_.mean()}, {"max", std::lround(evaluations_.max)}};
  j["added_mass_ratio"] = {{"mean", ratio_.mean()}, {"max", ratio_.max}};
  j["air_work_J"] = {{"fluid", work_fluid_},
                     {"structure", work_structure_},
                     {"largest_error_of_a_step", work_error_},
                     {"largest_step", work_scale_}};
  j["climb_angle_deg"] = climbAngleDegrees();
  j["speed_m_s"] = meanVelocity().norm();
  j["theta_B_deg"] = degrees(theta_B_);
  j["theta_R_deg"] = degrees(theta_R_);
  if (!case_.mirrored) {
    j["theta_L_deg"] = degrees(theta_L_);
    j["roll_deg"] = degrees(roll_);
  }
  if (!case_.insect.bare_wing)
    j["mid_plane"] = {{"depth_m", mid_plane_.depth()}, {"share_of_steps", mid_plane_.share()}};
  if (case_.guidance.kind != GuidanceKind::kMotion) {
    j["guidance"] = {{"type", guidanceName(case_.guidance)},
                     {"clipped", guidance_.clipped},
                     {"refused", guidance_.refused},
                     {"lost_from_flap", lost_ == kNever ? Json(nullptr) : Json(flapOf(lost_))}};
  }
  j["wall_s"] = {{"total", wallSeconds()}, {"fluid", wall_[0]},    {"flight", wall_[1]},
                 {"wing", wall_[2]},       {"guidance", wall_[3]}, {"exchange", exchange_},
                 {"coupling", coupling_},  {"outputs", outputs_}};
  if (!case_.mirrored) j["wall_s"]["fluid_left"] = wall_[4];
  if (cells_ > 0) j["fluid_s"] = kernels(kernels_, wall_[0] + wall_[4]);
  if (resumed_ != "[]") j["resumed"] = Json::parse(resumed_);
  j["ignored_messages"] = {{"late", ignored_.late},
                           {"repeated", ignored_.repeated},
                           {"foreign", ignored_.foreign},
                           {"malformed", ignored_.malformed},
                           {"forged", ignored_.forged}};
  j["cells"] = cells_;
  const PressureReference reference = pressureReference(case_);
  j["pressure_reference"] = {{"speed_m_s", reference.speed}, {"dynamic_Pa", reference.dynamic}};
  j["added_mass"] = matrix(added_mass_);
  j["state_sha256"] = hash_.hex();
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace monarch_flight
