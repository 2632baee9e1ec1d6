// Newmark on the rotation group, both wings' hinges included, against the same equations integrated
// by a method of high order.
#include "dynamics/six_dof.h"

#include <Eigen/Geometry>
#include <cmath>

#include "dynamics/given_flap.h"
#include "dynamics/rows.h"
#include "monarch_flight/coupling/coordinator.h"
#include "monarch_flight/coupling/participants.h"
#include "monarch_flight/math/rotation.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight::verify {

using Eigen::Vector3d;
using Layout = Eigen::Matrix<double, 17, 1>;

SixDofFlight::SixDofFlight(const Insect& insect, double gravity,
                           std::shared_ptr<const PrescribedMotion> motion, WingLoads loads)
    : motion_(std::move(motion)),
      loads_(std::move(loads)),
      flight_(insect, gravity, kAllEight, Newmark()),
      wings_{{Side::kRight, insect, gravity, Newmark()},
             {Side::kLeft, insect, gravity, Newmark()}} {}

OdeState SixDofFlight::state(const PrescribedState& at) {
  const Quaternion& q = at.body.q_IB;
  const auto& [right, left] = at.angles.wings;
  OdeState y(17);
  Eigen::Map<Layout>(y.data()) << at.body.x, q.w(), q.x(), q.y(), q.z(), at.body.v, at.body.Omega_B,
      right.theta.q, right.theta.qd, left.theta.q, left.theta.qd;
  return y;
}

PrescribedState SixDofFlight::motion(const OdeState& y, double t) const {
  const Eigen::Map<const Layout> s(y.data());
  PrescribedState now = motion_->at(t);
  BodyState& body = now.body;
  body.x = s.head<3>();
  body.q_IB = Quaternion(s(3), s(4), s(5), s(6)).normalized();
  body.v = s.segment<3>(7);
  body.Omega_B = s.segment<3>(10);
  now.angles.wings.right.theta = {s(13), s(14), 0.0};
  now.angles.wings.left.theta = {s(15), s(16), 0.0};
  // The body's accelerations are affine in those of both hinges, and the other way round.
  const PerWing<Loads> loads = loads_(t);
  constexpr double kProbe = 1e4;  // of the size of theta''
  const auto free = [&](double right, double left) {
    JointAngles angles = now.angles;
    angles.wings.right.theta.qdd = right;
    angles.wings.left.theta.qdd = left;
    return flight_.accelerations(body, angles, loads);
  };
  const BodyVector a0 = free(0.0, 0.0);
  Eigen::Matrix<double, 6, 2> A;
  A << (free(kProbe, 0.0) - a0) / kProbe, (free(0.0, kProbe) - a0) / kProbe;
  const auto hinges = [&](const BodyVector& a) -> Eigen::Vector2d {
    BodyState moved = body;
    moved.a = a.head<3>();
    moved.Omega_dot_B = a.tail<3>();
    return {wings_.right.acceleration(moved, now.angles, loads.right),
            wings_.left.acceleration(moved, now.angles, loads.left)};
  };
  const Eigen::Vector2d h0 = hinges(a0);
  Eigen::Matrix2d H;
  for (int i = 0; i < 2; ++i) H.col(i) = (hinges(a0 + kProbe * A.col(i)) - h0) / kProbe;
  const Eigen::Vector2d theta = (Eigen::Matrix2d::Identity() - H).partialPivLu().solve(h0);
  const BodyVector a = a0 + A * theta;
  body.a = a.head<3>();
  body.Omega_dot_B = a.tail<3>();
  setPitchAngle(body);
  now.angles.wings.right.theta.qdd = theta(0);
  now.angles.wings.left.theta.qdd = theta(1);
  return now;
}

void SixDofFlight::operator()(const OdeState& y, OdeState& dydt, double t) const {
  const PrescribedState now = motion(y, t);
  const Vector3d& W = now.body.Omega_B;
  const Eigen::Quaterniond q(y[3], y[4], y[5], y[6]);
  const Eigen::Quaterniond rate = q * Eigen::Quaterniond(0.0, W.x(), W.y(), W.z());
  const auto& [right, left] = now.angles.wings;
  Eigen::Map<Layout>(dydt.data()) << now.body.v, 0.5 * rate.w(), 0.5 * rate.x(), 0.5 * rate.y(),
      0.5 * rate.z(), now.body.a, now.body.Omega_dot_B, right.theta.qd, right.theta.qdd,
      left.theta.qd, left.theta.qdd;
}

PrescribedState AsymmetricMotion::at(double t) const {
  PrescribedState state = base_->at(t);
  const WingAngles late = base_->at(t - 0.05 * period_).angles.wings.right;
  WingAngles& left = state.angles.wings.left;
  left.phi = {0.85 * late.phi.q + 0.1, 0.85 * late.phi.qd, 0.85 * late.phi.qdd};
  left.psi = {late.psi.q - 0.08, late.psi.qd, late.psi.qdd};
  BodyState& body = state.body;
  body.v += Vector3d(0.0, 0.3, 0.0);
  body.q_IB = quaternionZ(0.5) * body.q_IB * quaternionX(-0.4);
  body.Omega_B += Vector3d(6.0, 0.0, -9.0);
  setPitchAngle(body);
  return state;
}

PerWing<Loads> asymmetricLoads(double frequency, double t) {
  PerWing<Loads> loads{smoothLoads(frequency, t), smoothLoads(frequency, t - 0.07 / frequency)};
  loads.left.force_pressure *= 0.8;
  loads.left.moment_pressure *= 0.8;
  return loads;
}

namespace {

Interface coupledFlap(const Case& c, std::shared_ptr<const PrescribedMotion> motion, int steps) {
  const double f = 1.0 / c.time.period;
  CoupledModel model{c.insect};
  model.mirrored = false;
  model.free = kAllEight;
  model.newmark.dt = c.time.period / steps;
  model.gravity = c.gravity;
  model.steps = static_cast<std::uint32_t>(steps);
  CouplingSettings settings = c.coupling;
  settings.prescribed_steps = 0;
  settings.tolerance = 1e-13;
  settings.load_tolerance = 1e-9;
  const auto of = [f](Side side) {
    return [f, side](double t) { return asymmetricLoads(f, t)[side]; };
  };
  FluidParticipant right(Side::kRight, model, std::make_unique<GivenLoads>(of(Side::kRight)));
  FluidParticipant left(Side::kLeft, model, std::make_unique<GivenLoads>(of(Side::kLeft)));
  FlightParticipant flight(model);
  WingParticipant wing(model);
  GuidanceParticipant guidance(model, std::make_unique<MotionGuidance>(std::move(motion)));
  LastStep sink;
  const StopFlag stop{false};
  FlyUntil control(stop);
  const auto outcome = Coordinator(model, settings, {&right, &flight, &wing, &guidance, &left}, 1)
                           .run({&sink}, control);
  if (!outcome.complete) throw std::runtime_error("coupled flap: " + outcome.failure);
  return sink.last.interface;
}

/// Largest of the differences over the size of the quantity.
double apart(const Interface& a, const PrescribedState& b) {
  const auto relative = [](double difference, double size) { return difference / size; };
  return std::max({relative((a.body.x - b.body.x).norm(), b.body.x.norm()),
                   relative(logSO3(a.body.R_IB().transpose() * b.body.R_IB()).norm(), 1.0),
                   relative((a.body.Omega_B - b.body.Omega_B).norm(), b.body.Omega_B.norm()),
                   relative(std::abs(a.theta.right.q - b.angles.wings.right.theta.q), 1.0),
                   relative(std::abs(a.theta.left.q - b.angles.wings.left.theta.q), 1.0)});
}

}  // namespace

DynamicsRows checkSixDof(const DynamicsFolders& folders) {
  const Case c = loadCase("climb_printed", {}, folders.config);
  const double f = 1.0 / c.time.period;
  const auto motion = std::make_shared<AsymmetricMotion>(c.motion, c.time.period);
  const SixDofFlight flight(c.insect, c.gravity, motion,
                            [f](double t) { return asymmetricLoads(f, t); });
  OdeState y = SixDofFlight::state(motion->at(0.0));
  const PrescribedState start = flight.motion(y, 0.0);
  integrate(flight, y, 0.0, c.time.period, 4000, [](const OdeState&, double) {});
  const PrescribedState exact = flight.motion(y, c.time.period);
  const auto started = std::make_shared<ConsistentStart>(motion, start);
  DynamicsRows rows;
  double before = 0.0, order = 0.0;
  for (int steps : {250, 500, 1000, 2000}) {
    const double error = apart(coupledFlap(c, started, steps), exact);
    rows.push_back({"six_dof", "asymmetric flap, eight coordinates: largest error",
                    std::to_string(steps) + " steps a flap", error, 0.0, error, kStated});
    order = std::log2(before / error);
    before = error;
  }
  rows.push_back({"six_dof", "asymmetric flap, eight coordinates: order",
                  "1000 and 2000 steps a flap", order, 2.0, std::abs(order - 2.0), 0.1});
  return rows;
}

}  // namespace monarch_flight::verify
