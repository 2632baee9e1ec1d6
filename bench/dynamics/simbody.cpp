// The same insect in Simbody (an independent multibody engine): body, abdomen, wings, the joints'
// motion, both springs, gravity and applied loads, over one flap.
#include <Simbody.h>

#include "dynamics/ode.h"
#include "dynamics/rows.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight::verify {
namespace {

using Eigen::Vector3d;
using AngleOfTime = std::function<Coordinate(double t)>;

SimTK::Vec3 vec(const Vector3d& a) { return {a.x(), a.y(), a.z()}; }

/// A joint's angle as a given function of time.
class GivenAngle : public SimTK::Motion::Custom::Implementation {
 public:
  explicit GivenAngle(AngleOfTime angle) : angle_(std::move(angle)) {}
  SimTK::Motion::Level getLevel(const SimTK::State&) const override {
    return SimTK::Motion::Position;
  }
  void calcPrescribedPosition(const SimTK::State& s, int, SimTK::Real* q) const override {
    q[0] = angle_(s.getTime()).q;
  }
  void calcPrescribedPositionDot(const SimTK::State& s, int, SimTK::Real* qd) const override {
    qd[0] = angle_(s.getTime()).qd;
  }
  void calcPrescribedPositionDotDot(const SimTK::State& s, int, SimTK::Real* qdd) const override {
    qdd[0] = angle_(s.getTime()).qdd;
  }

 private:
  AngleOfTime angle_;
};

/// Loads on one wing, in its axes, about its root.
class WingLoad : public SimTK::Force::Custom::Implementation {
 public:
  WingLoad(const SimTK::MobilizedBody& wing, std::function<Loads(double t)> loads)
      : wing_(wing), loads_(std::move(loads)) {}
  void calcForce(const SimTK::State& s, SimTK::Vector_<SimTK::SpatialVec>& bodies,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const override {
    const Loads loads = loads_(s.getTime());
    const SimTK::Rotation& R = wing_.getBodyRotation(s);
    wing_.applyForceToBodyPoint(s, SimTK::Vec3(0), R * vec(loads.force()), bodies);
    wing_.applyBodyTorque(s, R * vec(loads.moment()), bodies);
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

 private:
  const SimTK::MobilizedBody& wing_;
  std::function<Loads(double t)> loads_;
};

SimTK::Body::Rigid rigid(double mass, const Vector3d& centre, const Eigen::Matrix3d& J) {
  SimTK::Mat33 inertia;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) inertia(i, j) = J(i, j);
  }
  return SimTK::Body::Rigid(SimTK::MassProperties(mass, vec(centre), SimTK::Inertia(inertia)));
}

/// Rotation that takes z, the axis of Simbody's pin, to x or y.
SimTK::Rotation zTo(char axis) {
  if (axis == 'x') return SimTK::Rotation(0.5 * SimTK::Pi, SimTK::YAxis);
  if (axis == 'y') return SimTK::Rotation(-0.5 * SimTK::Pi, SimTK::XAxis);
  return SimTK::Rotation();
}

SimTK::MobilizedBody::Pin pin(SimTK::MobilizedBody& parent, const SimTK::Transform& frame,
                              char axis, const SimTK::Body& body) {
  const SimTK::Rotation R = zTo(axis);
  return {parent, SimTK::Transform(frame.R() * R, frame.p()), body, SimTK::Transform(R)};
}

class Engine {
 public:
  Engine(const Insect& insect, double gravity, std::shared_ptr<const PrescribedMotion> motion,
         double frequency)
      : matter_(system_), forces_(system_), motion_(std::move(motion)) {
    SimTK::Force::UniformGravity(forces_, matter_, SimTK::Vec3(0, 0, gravity));
    body_ = SimTK::MobilizedBody::Free(matter_.Ground(), SimTK::Transform(),
                                       rigid(insect.m_B, Vector3d::Zero(), insect.J_B),
                                       SimTK::Transform());
    SimTK::MobilizedBody::Pin abdomen =
        pin(body_, SimTK::Transform(vec(insect.abdomen.mu)), 'y',
            rigid(insect.abdomen.m, insect.abdomen.nu, insect.abdomen.J));
    give(
        abdomen, [](const JointAngles& a) { return a.theta_A; }, 1.0);
    right_ = wing(Side::kRight, insect);
    left_ = wing(Side::kLeft, insect);
    const auto on_right = [frequency](double t) { return smoothLoads(frequency, t); };
    SimTK::Force::Custom(forces_, new WingLoad(right_, on_right));
    SimTK::Force::Custom(
        forces_, new WingLoad(left_, [on_right](double t) { return mirrored(on_right(t)); }));
    state_ = system_.realizeTopology();
  }

  void start(const PrescribedState& s) {
    body_.setQToFitTransform(
        state_, SimTK::Transform(SimTK::Rotation(s.body.pitch.q, SimTK::YAxis), vec(s.body.x)));
    body_.setUToFitVelocity(state_,
                            SimTK::SpatialVec(SimTK::Vec3(0, s.body.pitch.qd, 0), vec(s.body.v)));
    for (Side side : kSides) {
      SimTK::MobilizedBody::Pin& wing = side == Side::kRight ? right_ : left_;
      wing.setOneQ(state_, 0, s.angles.wings[side].theta.q);
      wing.setOneU(state_, 0, s.angles.wings[side].theta.qd);
    }
    system_.realize(state_, SimTK::Stage::Time);
    system_.prescribe(state_);
  }

  /// (x, z, theta_B, theta_R) and rates at these times.
  std::vector<Eigen::Matrix<double, 8, 1>> run(const std::vector<double>& times) {
    SimTK::RungeKuttaMersonIntegrator integrator(system_);
    integrator.setAccuracy(1e-11);
    SimTK::TimeStepper stepper(system_, integrator);
    stepper.initialize(state_);
    std::vector<Eigen::Matrix<double, 8, 1>> answers;
    for (double t : times) {
      stepper.stepTo(t);
      const SimTK::State& s = integrator.getState();
      system_.realize(s, SimTK::Stage::Velocity);
      const SimTK::Vec3 x = body_.getBodyOriginLocation(s), v = body_.getBodyOriginVelocity(s);
      const SimTK::Rotation& R = body_.getBodyRotation(s);
      Eigen::Matrix<double, 8, 1> answer;
      answer << x[0], x[2], std::atan2(-R[2][0], R[0][0]), right_.getOneQ(s, 0), v[0], v[2],
          body_.getBodyAngularVelocity(s)[1], right_.getOneU(s, 0);
      answers.push_back(answer);
    }
    return answers;
  }

 private:
  void give(SimTK::MobilizedBody::Pin& joint,
            const std::function<Coordinate(const JointAngles&)>& which, double sign) {
    const auto motion = motion_;
    SimTK::Motion::Custom(joint, new GivenAngle([=](double t) {
                            const Coordinate q = which(motion->at(t).angles);
                            return Coordinate{sign * q.q, sign * q.qd, sign * q.qdd};
                          }));
  }

  /// Flapping, deviation (both given, on massless links) and the free pitch on its spring.
  SimTK::MobilizedBody::Pin wing(Side side, const Insect& insect) {
    const Wing& own = insect.wings[side];
    const Appendage part = side == Side::kRight ? own.plate : mirrored(own.plate);
    const double sign = side == Side::kRight ? 1.0 : -1.0;
    const SimTK::Transform stroke(SimTK::Rotation(insect.beta, SimTK::YAxis), vec(part.mu));
    SimTK::MobilizedBody::Pin flap = pin(body_, stroke, 'x', SimTK::Body::Massless());
    give(
        flap, [side](const JointAngles& a) { return a.wings[side].phi; }, sign);
    SimTK::MobilizedBody::Pin deviation =
        pin(flap, SimTK::Transform(), 'z', SimTK::Body::Massless());
    give(
        deviation, [side](const JointAngles& a) { return a.wings[side].psi; }, -sign);
    SimTK::MobilizedBody::Pin pitch =
        pin(deviation, SimTK::Transform(), 'y', rigid(part.m, part.nu, part.J));
    SimTK::Force::MobilityLinearSpring(forces_, pitch, SimTK::MobilizerQIndex(0), own.kappa,
                                       own.theta_0);
    return pitch;
  }

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::shared_ptr<const PrescribedMotion> motion_;
  SimTK::MobilizedBody::Free body_;
  SimTK::MobilizedBody::Pin right_, left_;
  SimTK::State state_;
};

}  // namespace

DynamicsRows checkSimbody(const DynamicsFolders& folders) {
  const Case c = loadCase("climb_printed", {}, folders.config);
  const double f = 1.0 / c.time.period;
  const LongitudinalFlight flight(c.insect, c.gravity, c.motion,
                                  [f](double t) { return smoothLoads(f, t); });
  constexpr int kTimes = 20;
  Engine engine(c.insect, c.gravity, c.motion, f);
  engine.start(c.motion->at(0.0));
  std::vector<double> times;
  for (int n = 1; n <= kTimes; ++n) times.push_back(n * c.time.period / kTimes);
  const auto theirs = engine.run(times);

  OdeState y = flight.state(0.0);
  Eigen::Matrix<double, 8, 1> scale = Eigen::Matrix<double, 8, 1>::Zero(), worst = scale;
  double t = 0.0;
  for (int n = 0; n < kTimes; ++n) {
    integrate(flight, y, t, times[n], 200, [](const OdeState&, double) {});
    t = times[n];
    const Eigen::Map<const Eigen::Matrix<double, 8, 1>> ours(y.data());
    worst = worst.cwiseMax((ours - theirs[n]).cwiseAbs());
    scale = scale.cwiseMax(theirs[n].cwiseAbs());
  }
  const char* names[] = {"x", "z", "theta_B", "theta_R", "x'", "z'", "theta_B'", "theta_R'"};
  DynamicsRows rows;
  for (int i = 0; i < 8; ++i) {
    rows.push_back({"simbody", std::string(names[i]) + ", largest difference in a flap / largest",
                    "Runge-Kutta-Merson, accuracy 1e-11", worst(i), scale(i), worst(i) / scale(i),
                    1e-6});
  }
  return rows;
}

}  // namespace monarch_flight::verify
