// The same insect in Simbody (an independent multibody engine): body, abdomen, wings, the joints'
// motion, both springs, gravity and applied loads, over one flap.
#include <Simbody.h>

#include "dynamics/rows.h"
#include "dynamics/six_dof.h"
#include "monarch_flight/math/rotation.h"
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

/// Of body and hinges at one time.
struct EngineState {
  Vector3d x, v, Omega_B;
  Eigen::Matrix3d R_IB;
  PerWing<double> theta, theta_dot;
};

class Engine {
 public:
  using WingLoads = std::function<PerWing<Loads>(double t)>;
  Engine(const Insect& insect, double gravity, std::shared_ptr<const PrescribedMotion> motion,
         const WingLoads& loads)
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
    SimTK::Force::Custom(forces_,
                         new WingLoad(right_, [loads](double t) { return loads(t).right; }));
    SimTK::Force::Custom(
        forces_, new WingLoad(left_, [loads](double t) { return mirrored(loads(t).left); }));
    state_ = system_.realizeTopology();
  }

  void start(const PrescribedState& s) {
    SimTK::Mat33 R;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) R(i, j) = s.body.R_IB()(i, j);
    }
    body_.setQToFitTransform(state_, SimTK::Transform(SimTK::Rotation(R), vec(s.body.x)));
    body_.setUToFitVelocity(state_,
                            SimTK::SpatialVec(vec(s.body.R_IB() * s.body.Omega_B), vec(s.body.v)));
    for (Side side : kSides) {
      SimTK::MobilizedBody::Pin& wing = side == Side::kRight ? right_ : left_;
      wing.setOneQ(state_, 0, s.angles.wings[side].theta.q);
      wing.setOneU(state_, 0, s.angles.wings[side].theta.qd);
    }
    system_.realize(state_, SimTK::Stage::Time);
    system_.prescribe(state_);
  }

  std::vector<EngineState> run(const std::vector<double>& times) {
    SimTK::RungeKuttaMersonIntegrator integrator(system_);
    integrator.setAccuracy(1e-11);
    SimTK::TimeStepper stepper(system_, integrator);
    stepper.initialize(state_);
    std::vector<EngineState> answers;
    for (double t : times) {
      stepper.stepTo(t);
      const SimTK::State& s = integrator.getState();
      system_.realize(s, SimTK::Stage::Velocity);
      const auto vector = [](const SimTK::Vec3& a) { return Vector3d(a[0], a[1], a[2]); };
      EngineState answer;
      answer.x = vector(body_.getBodyOriginLocation(s));
      answer.v = vector(body_.getBodyOriginVelocity(s));
      const SimTK::Rotation& R = body_.getBodyRotation(s);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) answer.R_IB(i, j) = R[i][j];
      }
      answer.Omega_B = answer.R_IB.transpose() * vector(body_.getBodyAngularVelocity(s));
      answer.theta = {right_.getOneQ(s, 0), left_.getOneQ(s, 0)};
      answer.theta_dot = {right_.getOneU(s, 0), left_.getOneU(s, 0)};
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

std::vector<double> twentyTimes(double period) {
  std::vector<double> times;
  for (int n = 1; n <= 20; ++n) times.push_back(n * period / 20);
  return times;
}

/// The flight `system` from `y`, at these times.
template <typename System, typename See>
void follow(const System& system, OdeState y, const std::vector<double>& times, const See& see) {
  double t = 0.0;
  for (std::size_t n = 0; n < times.size(); ++n) {
    integrate(system, y, t, times[n], 200, [](const OdeState&, double) {});
    t = times[n];
    see(n, y);
  }
}

constexpr char kMethod[] = "Runge-Kutta-Merson, accuracy 1e-11";

void addLongitudinal(const Case& c, DynamicsRows& rows) {
  const double f = 1.0 / c.time.period;
  const LongitudinalFlight flight(c.insect, c.gravity, c.motion,
                                  [f](double t) { return smoothLoads(f, t); });
  Engine engine(c.insect, c.gravity, c.motion, [f](double t) {
    return PerWing<Loads>{smoothLoads(f, t), smoothLoads(f, t)};
  });
  engine.start(c.motion->at(0.0));
  const std::vector<double> times = twentyTimes(c.time.period);
  const std::vector<EngineState> theirs = engine.run(times);
  using Row = Eigen::Matrix<double, 8, 1>;
  Row scale = Row::Zero(), worst = Row::Zero();
  follow(flight, flight.state(0.0), times, [&](std::size_t n, const OdeState& y) {
    const EngineState& s = theirs[n];
    Row answer;
    answer << s.x.x(), s.x.z(), std::atan2(-s.R_IB(2, 0), s.R_IB(0, 0)), s.theta.right, s.v.x(),
        s.v.z(), s.Omega_B.y(), s.theta_dot.right;
    const Eigen::Map<const Row> ours(y.data());
    worst = worst.cwiseMax((ours - answer).cwiseAbs());
    scale = scale.cwiseMax(answer.cwiseAbs());
  });
  const char* names[] = {"x", "z", "theta_B", "theta_R", "x'", "z'", "theta_B'", "theta_R'"};
  for (int i = 0; i < 8; ++i) {
    rows.push_back({"simbody", std::string(names[i]) + ", largest difference in a flap / largest",
                    kMethod, worst(i), scale(i), worst(i) / scale(i), 1e-6});
  }
}

/// Six degrees of freedom, both hinges, wings that differ in planform, hinge, motion and loads.
void addSixDof(Case c, DynamicsRows& rows) {
  const double f = 1.0 / c.time.period;
  Wing& damaged = c.insect.wings.left;
  const double mass = 0.8 * damaged.plate.m, stiffness = 0.7 * damaged.kappa;
  const Vector3d root = damaged.plate.mu;
  damaged.planform = damaged.planform.withoutTip(0.2);
  damaged.plate = plateWing(damaged.planform, mass, root);
  damaged.kappa = stiffness;
  const auto motion = std::make_shared<AsymmetricMotion>(c.motion, c.time.period);
  const auto loads = [f](double t) { return asymmetricLoads(f, t); };
  const SixDofFlight flight(c.insect, c.gravity, motion, loads);
  Engine engine(c.insect, c.gravity, motion, loads);
  engine.start(motion->at(0.0));
  const std::vector<double> times = twentyTimes(c.time.period);
  const std::vector<EngineState> theirs = engine.run(times);
  Eigen::Matrix<double, 6, 1> scale = Eigen::Matrix<double, 6, 1>::Zero(), worst = scale;
  follow(flight, SixDofFlight::state(motion->at(0.0)), times,
         [&](std::size_t n, const OdeState& y) {
           const EngineState& s = theirs[n];
           const PrescribedState ours = flight.motion(y, times[n]);
           const auto& [right, left] = ours.angles.wings;
           // In its true axes the left wing pitches as its mirror image does.
           Eigen::Matrix<double, 6, 1> difference, size;
           difference << (ours.body.x - s.x).norm(),
               logSO3(ours.body.R_IB().transpose() * s.R_IB).norm(),
               std::hypot(right.theta.q - s.theta.right, left.theta.q - s.theta.left),
               (ours.body.v - s.v).norm(), (ours.body.Omega_B - s.Omega_B).norm(),
               std::hypot(right.theta.qd - s.theta_dot.right, left.theta.qd - s.theta_dot.left);
           size << s.x.norm(), 1.0, std::hypot(s.theta.right, s.theta.left), s.v.norm(),
               s.Omega_B.norm(), std::hypot(s.theta_dot.right, s.theta_dot.left);
           worst = worst.cwiseMax(difference);
           scale = scale.cwiseMax(size);
         });
  const char* names[] = {"position", "attitude",         "both wings' pitch",
                         "velocity", "angular velocity", "both wings' pitch rate"};
  for (int i = 0; i < 6; ++i) {
    rows.push_back({"simbody",
                    std::string(names[i]) + ", largest difference in a asymmetric flap / largest",
                    kMethod, worst(i), scale(i), worst(i) / scale(i), 1e-6});
  }
}

}  // namespace

DynamicsRows checkSimbody(const DynamicsFolders& folders) {
  const Case c = loadCase("climb_printed", {}, folders.config);
  DynamicsRows rows;
  addLongitudinal(c, rows);
  addSixDof(c, rows);
  return rows;
}

}  // namespace monarch_flight::verify
