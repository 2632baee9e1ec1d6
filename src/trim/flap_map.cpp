#include "monarch_flight/trim/flap_map.h"

#include <yaml-cpp/yaml.h>

#include <cmath>

#include "monarch_flight/insect/start_motion.h"
#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/trim/periodic_shape.h"
#include "trim/case_edit.h"
#include "trim/flap_recorder.h"

namespace monarch_flight {
namespace {

constexpr int kHarmonics = 8;

/// A map of a case in memory is a function of its text, so threads may share nothing but the text.
Case changedCase(const Case& base, const std::vector<TrimParameter>& parameters,
                 const TrimPoint& point, const std::string& config_dir) {
  CaseEdit edit(base.resolved_yaml);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    edit.set(parameters[i].path, point.parameters(static_cast<Eigen::Index>(i)));
  }
  return caseFromText(edit.text(), base.name + " with changed parameters", {}, config_dir);
}

/// An explicit start, for a state that no flight in the plane of symmetry passes through.
void setInitial(CaseEdit& edit, const FreeCoordinates& free, const FlapState& s) {
  edit.setVector({"initial", "velocity"}, {s(0), s(6), s(1)});
  const std::pair<const char*, FreeCoordinate> angles[] = {
      {"theta_B", kPitch}, {"theta_R", kThetaR}, {"roll", kRoll}, {"theta_L", kThetaL}};
  const int places[] = {2, 4, 7, 10};
  for (int i = 0; i < 4; ++i) {
    const auto& [name, coordinate] = angles[i];
    if (!free[coordinate]) continue;
    edit.set({"initial", name}, s(places[i]));
    edit.set({"initial", std::string(name) + "_dot"}, s(places[i] + 1));
  }
  if (!free[kYaw]) return;
  edit.set({"initial", "yaw"}, 0.0);  // the velocity's axes
  edit.set({"initial", "yaw_dot"}, s(9));
}

}  // namespace

const std::vector<TrimParameter>& trimParameters() {
  static const std::vector<TrimParameter> all = {
      {"m_B", {"insect", "body", "mass"}, "kg", 2e-5, 0, 0},
      {"m_A", {"insect", "abdomen", "mass"}, "kg", 2e-5, 0, 0},
      {"m_R", {"insect", "wing", "mass"}, "kg", 2e-6, 0, 0},
      {"kappa", {"insect", "wing", "kappa"}, "N m/rad", 2e-5, 0, 0},
      {"theta_0", {"insect", "wing", "theta_0"}, "rad", 0.1, 0, 0},
      {"root_x", {"insect", "wing", "root", "0"}, "m", 5e-4, 0, 0},
      {"root_z", {"insect", "wing", "root", "2"}, "m", 5e-4, 0, 0},
      {"hinge", {"insect", "wing", "planform", "hinge"}, "of the outline's unit", 0.05, 0, 0}};
  return all;
}

FlapMap::FlapMap(const Case& c, const std::string& config_dir,
                 std::vector<TrimParameter> parameters, int run_in)
    : base_(c), config_dir_(config_dir), parameters_(std::move(parameters)), run_in_(run_in) {
  std::vector<std::string> faults;
  const CaseEdit edit(c.resolved_yaml);
  if (edit.at({"motion", "type"}) != "fourier" || !(c.time.period > 0.0)) {
    faults.push_back(
        "motion: must be a Fourier series with motion/frequency > 0 to be trimmed; "
        "give motion/type fourier and a frequency");
  }
  const double steps = std::round(c.time.stepsPerFlap());
  if (c.time.period > 0.0 && std::abs(c.time.stepsPerFlap() - steps) > 1e-6) {
    faults.push_back("time: a flap must be a whole number of steps; give time/steps_per_flap");
  }
  if (c.free.count() == 0) {
    faults.push_back(
        "free: nothing is free, so there is nothing to trim; free x, z, pitch or "
        "wing_pitch");
  }
  const bool sideways = c.free[kY] || c.free[kRoll] || c.free[kYaw] || c.free[kThetaL];
  if (sideways && c.fluid == FluidKind::kNavierStokes) {
    faults.push_back(
        "fluid: must be quasi_steady for independent wings, whose flight leaves the plane of "
        "symmetry "
        "while the run-in of a wake stays in it; give fluid:=quasi_steady, or wings:=mirrored");
  } else if (sideways && run_in > 0) {
    faults.push_back(
        "run_in = " + std::to_string(run_in) +
        ": must be 0 for independent wings, the run-in flies in the plane of symmetry; "
        "give run_in:=0, or wings:=mirrored");
  }
  if (run_in < 0) {
    faults.push_back("run_in = " + std::to_string(run_in) + ": must be >= 0 flaps; 1 is usual");
  }
  if (!faults.empty()) throw InputError(faults);
  per_flap_ = static_cast<std::uint32_t>(steps);
  const bool is_free[kFlapStates] = {
      c.free[kX], c.free[kZ],    c.free[kPitch], c.free[kPitch], c.free[kThetaR], c.free[kThetaR],
      c.free[kY], c.free[kRoll], c.free[kRoll],  c.free[kYaw],   c.free[kThetaL], c.free[kThetaL]};
  for (int i = 0; i < kFlapStates; ++i) {
    if (is_free[i]) active_.push_back(i);
  }
}

TrimPoint FlapMap::start() const {
  const PrescribedState s = base_.motion->at(base_.time.t_start);
  TrimPoint point;
  point.state = flapState(s.interface());
  point.parameters.resize(static_cast<Eigen::Index>(parameters_.size()));
  const CaseEdit edit(base_.resolved_yaml);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    point.parameters(static_cast<Eigen::Index>(i)) = std::stod(edit.at(parameters_[i].path));
  }
  std::array<std::vector<double>, 4> samples;
  for (std::uint32_t k = 0; k <= per_flap_; ++k) {
    const PrescribedState at = base_.motion->at(base_.time.time(k));
    samples[0].push_back(at.body.x.x());
    samples[1].push_back(at.body.x.z());
    samples[2].push_back(at.body.pitch.q);
    samples[3].push_back(at.angles.wings.right.theta.q);
  }
  point.shape = flapShape(samples, base_.time, kHarmonics);
  return point;
}

Case FlapMap::withStart(const TrimPoint& point, const FlapState& a) const {
  Case c = changedCase(base_, parameters_, point, config_dir_);
  const Eigen::Vector3d place = c.motion->at(c.time.t_start).body.x;
  c.motion = std::make_shared<StartMotion>(c.motion, startOf(c.free, place, point.state, a),
                                           c.time.t_start);
  c.coupling.prescribed_steps = 0;
  c.coupling.accelerations_known = true;
  return c;
}

FlapState FlapMap::consistentAccelerations(const TrimPoint& point) const {
  constexpr int kPasses = 3;
  FlapState a = FlapState::Zero();
  for (int pass = 0; pass < kPasses; ++pass) {
    Case c = withStart(point, a);
    c.time.steps = 2;
    FlapRecorder recorder(c.time, 0, 1);
    if (!flyCase(c, recorder).complete) break;
    const auto& levels = recorder.accelerations();
    a = 2.0 * levels[1] - levels[2];  // extrapolated to the start
  }
  return a;
}

Flight FlapMap::fly(const TrimPoint& point, int flaps) const {
  if (run_in_ == 0) {
    Case c = withStart(point, consistentAccelerations(point));
    c.time.steps = per_flap_ * static_cast<std::uint32_t>(flaps);
    FlapRecorder recorder(c.time, 0, kHarmonics);
    return flyCase(c, recorder);
  }
  const int steps = run_in_ * static_cast<int>(per_flap_);
  const Case c =
      caseFromText(caseText(point, steps, flaps), base_.name + " with run-in", {}, config_dir_);
  FlapRecorder recorder(c.time, static_cast<std::uint32_t>(steps), kHarmonics);
  return flyCase(c, recorder);
}

std::string FlapMap::caseText(const TrimPoint& point, int run_in_steps, int flaps) const {
  const double f = 1.0 / base_.time.period, t0 = base_.time.t_start;
  const FlapState& s = point.state;
  CaseEdit edit(base_.resolved_yaml);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    edit.set(parameters_[i].path, point.parameters(static_cast<Eigen::Index>(i)));
  }
  Eigen::Vector3d velocity = base_.motion->at(t0).body.v;
  if (base_.free[kX]) {
    edit.setSeries({"motion", "body", "sway_x"}, point.shape.x, 1.0);
    velocity.x() = s(0) - rateAt(point.shape.x, f, t0);
  }
  if (base_.free[kZ]) {
    edit.setSeries({"motion", "body", "sway_z"}, point.shape.z, 1.0);
    velocity.z() = s(1) - rateAt(point.shape.z, f, t0);
  }
  edit.setVector({"motion", "body", "velocity"}, velocity);
  if (base_.free[kPitch]) {
    edit.setSeries({"motion", "theta_B_deg"}, through(point.shape.theta_B, f, t0, s(2), s(3)),
                   kDegree);
  }
  if (base_.free[kThetaR]) {
    edit.setSeries({"motion", "theta_R_deg"}, through(point.shape.theta_R, f, t0, s(4), s(5)),
                   kDegree);
  }
  if (base_.mirrored || inPlane(s)) {
    edit.remove({"initial"});
  } else {
    setInitial(edit, base_.free, s);
    run_in_steps = 0;
  }
  edit.remove({"coupling", "prescribed_flaps"});
  edit.set({"coupling", "prescribed_steps"}, run_in_steps);
  edit.set({"time", "flaps"}, flaps + run_in_steps / static_cast<double>(per_flap_));
  return edit.text();
}

}  // namespace monarch_flight
