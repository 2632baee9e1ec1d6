#pragma once
// Stand-ins for the tests of the coupling.
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/test_insect.h"
#include "monarch_flight/coupling/coordinator.h"
#include "monarch_flight/coupling/participants.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace testing {

/// Air that answers a linear law of the wing's motion: loads = - M (a; alpha) - C (v; omega). It
/// keeps the committed velocity so that a missing or a wrong commit shows in the loads.
class LinearAir : public FluidModel {
 public:
  LinearAir(const Matrix6d& M, const Matrix6d& C) : M_(M), C_(C) {}
  void start(const WingMotion& motion, double) override { committed_ = velocity(motion); }
  Loads evaluate(const WingMotion& next) override {
    ++evaluations;
    if (fail) fail(evaluations);
    last_ = velocity(next);
    evaluated_ = true;
    const Vector6d load = -M_ * acceleration(next) - C_ * (0.5 * (committed_ + last_));
    return {load.head<3>(), Eigen::Vector3d::Zero(), load.tail<3>(), Eigen::Vector3d::Zero()};
  }
  Loads linearise(const WingMotion& next, LoadOperator& jacobian) override {
    ++operators;
    jacobian.velocity = -0.5 * C_;
    jacobian.acceleration = -M_;
    return evaluate(next);
  }
  int operatorCost() const override { return operator_cost; }
  void commit() override {
    if (!evaluated_) throw std::logic_error("commit without evaluate");
    committed_ = last_;
    evaluated_ = false;
    ++commits;
  }
  std::vector<char> save() const override { return {}; }
  void restore(const std::vector<char>&) override {}
  Matrix6d addedMass() const override { return M_; }
  FluidReport report() const override { return {}; }
  long cells() const override { return 42; }
  SurfacePressure surfacePressure() const override { return {{{0.f, 0.f, 1.f, 1.f, 2.f, 3.f}}}; }
  FlowPicture flowPicture(std::size_t limit) const override {
    FlowPicture picture;
    picture.size = {static_cast<std::uint32_t>(limit), 1, 1};
    picture.spacing = 1.0f;
    picture.q_root.resize(limit);
    picture.omega_y.resize(limit);
    return picture;
  }

  /// Loads for a motion, given the velocity of level n: for the monolithic solution.
  Loads law(const Vector6d& velocity_n, const WingMotion& next) const {
    const Vector6d load = -M_ * acceleration(next) - C_ * (0.5 * (velocity_n + velocity(next)));
    return {load.head<3>(), Eigen::Vector3d::Zero(), load.tail<3>(), Eigen::Vector3d::Zero()};
  }
  static Vector6d velocity(const WingMotion& motion) {
    Vector6d v;
    v << motion.v_W, motion.omega_W;
    return v;
  }

  int evaluations = 0, commits = 0, operators = 0, operator_cost = 6;
  std::function<void(int)> fail;  ///< called with the number of the evaluation

 private:
  static Vector6d acceleration(const WingMotion& motion) {
    Vector6d a;
    a << motion.a_W, motion.alpha_W;
    return a;
  }
  Matrix6d M_, C_;
  Vector6d committed_ = Vector6d::Zero(), last_ = Vector6d::Zero();
  bool evaluated_ = false;
};

/// Added mass and damping of the order of a monarch's wing, `ratio` times over.
inline LinearAir monarchAir(double ratio) {
  Matrix6d M = Matrix6d::Zero();
  // Normal force, moments about x and y for a plate with its centre at (-0.25 c, 0.45 l).
  const double m = ratio * 2.3e-5, x = -0.0052, y = 0.027;
  Eigen::Matrix3d normal;
  normal << m, m * y, -m * x, m * y, m * (y * y + 3e-4), -m * x * y, -m * x, -m * x * y,
      m * (x * x + 2e-5);
  const int rows[3] = {2, 3, 4};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) M(rows[i], rows[j]) = normal(i, j);
  }
  return LinearAir(M, 60.0 * M);
}

/// Flapping by sines with everything else still, the body moving at constant velocity.
class SineFlapping : public PrescribedMotion {
 public:
  PrescribedState at(double t) const override {
    if (t > last) throw std::out_of_range("motion ends at " + std::to_string(last) + " s");
    const double w = 2.0 * M_PI * 10.0;
    PrescribedState state;
    state.body.x = Eigen::Vector3d(1.0 * t, 0.0, -0.5 * t);
    state.body.v = Eigen::Vector3d(1.0, 0.0, -0.5);
    state.body = withPitch(state.body, {0.3, 0.0, 0.0});
    state.angles.wings = both(WingAngles{
        wave(0.1, 0.9, w, 1.4, t), wave(0.0, 0.05, 2.0 * w, 0.2, t), wave(0.0, 0.5, w, 0.1, t)});
    state.angles.theta_A = wave(0.3, 0.2, w, 2.0, t);
    return state;
  }
  double last = 1e9;
};

inline CoupledModel coupledModel(const FreeCoordinates& free, std::uint32_t steps) {
  CoupledModel model{publishedMonarch()};
  model.free = free;
  model.newmark.dt = 1e-4;
  model.steps = steps;
  model.t_start = 0.02;
  return model;
}

inline CouplingSettings couplingSettings() {
  CouplingSettings settings;
  settings.length_scale = 0.0209;
  return settings;
}

/// A participant that passes everything on and keeps what went by.
class Recorder : public Participant {
 public:
  explicit Recorder(Participant& inner) : inner_(inner) {}
  Reply exchange(const Request& request) override {
    requests.push_back(request);
    Reply reply = inner_.exchange(request);
    if (change) change(reply);
    return reply;
  }
  int count(Phase phase) const {
    int n = 0;
    for (const Request& r : requests) n += r.key.phase == phase;
    return n;
  }
  std::vector<Request> requests;
  std::function<void(Reply&)> change;

 private:
  Participant& inner_;
};

class KeepingSink : public StepSink {
 public:
  void onStep(const CommittedStep& step) override {
    steps.push_back(step);
    if (each) each(step);
  }
  void onReset() override {
    ++resets;
    steps.clear();
  }
  void onEnd(const std::string& text) override {
    ++ends;
    failure = text;
  }
  std::vector<CommittedStep> steps;
  std::function<void(const CommittedStep&)> each;
  int ends = 0, resets = 0;
  std::string failure;
};

/// A coupled run in one process, everything within reach.
struct Federation {
  Federation(const CoupledModel& model_in, const CouplingSettings& settings_in,
             const LinearAir& air_in,
             std::shared_ptr<const PrescribedMotion> motion_in = std::make_shared<SineFlapping>())
      : model(model_in), settings(settings_in), motion(std::move(motion_in)) {
    auto owned = std::make_unique<LinearAir>(air_in);
    air = owned.get();
    fluid_solver = std::make_unique<FluidParticipant>(Side::kRight, model, std::move(owned));
    flight_solver = std::make_unique<FlightParticipant>(model);
    wing_solver = std::make_unique<WingParticipant>(model);
    guidance_solver =
        std::make_unique<GuidanceParticipant>(model, std::make_unique<MotionGuidance>(motion));
    guidance = std::make_unique<Recorder>(*guidance_solver);
    fluid = std::make_unique<Recorder>(*fluid_solver);
    flight = std::make_unique<Recorder>(*flight_solver);
    wing = std::make_unique<Recorder>(*wing_solver);
  }
  CoupledOutcome run() {
    FlyUntil control(stop);
    return run(control);
  }
  CoupledOutcome run(RunControl& control) {
    return Coordinator(model, settings, participants(), 7).run({&sink}, control);
  }
  Participants participants() {
    return {fluid.get(), flight.get(), wing.get(), guidance.get(), nullptr};
  }
  /// Everything as guidance prescribes it.
  Interface prescribed(double t) const { return motion->at(t).interface(); }

  CoupledModel model;
  CouplingSettings settings;
  std::shared_ptr<const PrescribedMotion> motion;
  LinearAir* air;
  std::unique_ptr<Participant> fluid_solver, flight_solver, wing_solver, guidance_solver;
  std::unique_ptr<Recorder> fluid, flight, wing, guidance;
  KeepingSink sink;
  StopFlag stop{false};
};

/// Of two interfaces, positions over `length` [m], angles in rad.
inline double dimensionlessDistance(const Interface& a, const Interface& b, double length) {
  return std::max({(a.body.x - b.body.x).cwiseAbs().maxCoeff() / length,
                   std::abs(a.body.pitch.q - b.body.pitch.q),
                   std::abs(a.theta.right.q - b.theta.right.q),
                   std::abs(a.theta.left.q - b.theta.left.q)});
}

}  // namespace testing
}  // namespace monarch_flight
