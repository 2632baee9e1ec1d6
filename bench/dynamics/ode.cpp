#include "dynamics/ode.h"

#include <Eigen/Geometry>
#include <cmath>

namespace monarch_flight::verify {

using Eigen::Vector3d;

FreeInsect::FreeInsect(const Insect& insect, double gravity, Joints joints, JointLoads loads)
    : dynamics_(insect, gravity), joints_(std::move(joints)), loads_(std::move(loads)) {}

OdeState FreeInsect::state(const BodyState& body) {
  const Quaternion& q = body.q_IB;
  OdeState y(13);
  Eigen::Map<Eigen::Matrix<double, 13, 1>>(y.data()) << body.x, q.w(), q.x(), q.y(), q.z(), body.v,
      body.Omega_B;
  return y;
}

InsectMotion FreeInsect::motion(const OdeState& y, double t) const {
  const Eigen::Map<const Eigen::Matrix<double, 13, 1>> s(y.data());
  InsectMotion m;
  m.body.x = s.head<3>();
  m.body.q_IB = Quaternion(s(3), s(4), s(5), s(6)).normalized();
  m.body.v = s.segment<3>(7);
  m.body.Omega_B = s.tail<3>();
  m.joints = joints_(t);
  const Vector15d rest =
      dynamics_.appliedForce(m, loads_(t)) + dynamics_.gravityForce(m) - dynamics_.inertialForce(m);
  const Eigen::Matrix<double, 6, 6> J = dynamics_.inertia(m).topLeftCorner<6, 6>();
  const Vector6d a = J.llt().solve(rest.head<6>());
  m.body.a = a.head<3>();
  m.body.Omega_dot_B = a.tail<3>();
  return m;
}

void FreeInsect::operator()(const OdeState& y, OdeState& dydt, double t) const {
  const InsectMotion m = motion(y, t);
  const Eigen::Quaterniond q(y[3], y[4], y[5], y[6]);
  const Vector3d& W = m.body.Omega_B;
  const Eigen::Quaterniond rate = q * Eigen::Quaterniond(0.0, W.x(), W.y(), W.z());
  Eigen::Map<Eigen::Matrix<double, 13, 1>>(dydt.data()) << m.body.v, 0.5 * rate.w(), 0.5 * rate.x(),
      0.5 * rate.y(), 0.5 * rate.z(), m.body.a, m.body.Omega_dot_B;
}

Eigen::Vector4d coupledAccelerations(const FlightSolver& flight, const WingPitchSolver& wing,
                                     const BodyState& body, JointAngles angles,
                                     const Loads& loads) {
  constexpr double kProbe = 1e4;  // of the size of theta_R''
  const auto free = [&](double theta_ddot) -> Vector3d {
    for (Side side : kSides) angles.wings[side].theta.qdd = theta_ddot;
    const BodyVector a = flight.accelerations(body, angles, {loads, loads});
    return {a(kX), a(kZ), a(kPitch)};
  };
  const Vector3d f0 = free(0.0), f1 = (free(kProbe) - f0) / kProbe;
  const auto pitch = [&](const Vector3d& a) {
    BodyState moved = body;
    moved.a.x() = a(0);
    moved.a.z() = a(1);
    moved.pitch.qdd = a(2);
    moved.Omega_dot_B.y() = a(2);
    return wing.acceleration(moved, angles, loads);
  };
  const double w0 = pitch(f0), w1 = (pitch(f0 + kProbe * f1) - w0) / kProbe;
  const double theta = w0 / (1.0 - w1);
  const Vector3d a = f0 + theta * f1;
  return {a(0), a(1), a(2), theta};
}

LongitudinalFlight::LongitudinalFlight(const Insect& insect, double gravity,
                                       std::shared_ptr<const PrescribedMotion> motion,
                                       RightLoads loads)
    : insect_(insect),
      motion_(std::move(motion)),
      loads_(std::move(loads)),
      flight_(insect, gravity, kAllFree, Newmark()),
      wing_(Side::kRight, insect, gravity, Newmark()) {}

OdeState LongitudinalFlight::state(double t) const {
  const PrescribedState s = motion_->at(t);
  const Coordinate& theta = s.angles.wings.right.theta;
  return {s.body.x.x(), s.body.x.z(),    s.body.pitch.q, theta.q, s.body.v.x(),
          s.body.v.z(), s.body.pitch.qd, theta.qd,       0.0,     0.0};
}

PrescribedState LongitudinalFlight::motion(const OdeState& y, double t) const {
  PrescribedState s = motion_->at(t);
  s.body.x = {y[0], 0.0, y[1]};
  s.body.v = {y[4], 0.0, y[5]};
  s.body.a.setZero();
  s.body = withPitch(s.body, {y[2], y[6], 0.0});
  for (Side side : kSides) s.angles.wings[side].theta = {y[3], y[7], 0.0};
  const Eigen::Vector4d a = coupledAccelerations(flight_, wing_, s.body, s.angles, loads_(t));
  s.body.a = {a(0), 0.0, a(1)};
  s.body = withPitch(s.body, {y[2], y[6], a(2)});
  for (Side side : kSides) s.angles.wings[side].theta.qdd = a(3);
  return s;
}

void LongitudinalFlight::operator()(const OdeState& y, OdeState& dydt, double t) const {
  const PrescribedState s = motion(y, t);
  const InsectMotion m = insectMotion(insect_.beta, s.body, s.angles);
  const Loads loads = loads_(t);
  const auto torque = flight_.dynamics().jointTorques(m, {loads, loads});
  const Wing& hinge = insect_.wings.right;
  const Coordinate& theta = s.angles.wings.right.theta;
  double actuators = 2.0 * hinge.kappa * (theta.q - hinge.theta_0) * theta.qd;
  for (std::size_t i = 0; i < 3; ++i) actuators += torque[i].dot(m.joints[i].Omega);
  const WingMotion wing = wingMotion(Side::kRight, insect_, s.body, s.angles);
  const double air = 2.0 * (loads.force().dot(wing.v_W) + loads.moment().dot(wing.omega_W));
  dydt = {y[4],      y[5],      y[6], y[7], s.body.a.x(), s.body.a.z(), s.body.pitch.qdd,
          theta.qdd, actuators, air};
}

double LongitudinalFlight::kineticEnergy(const OdeState& y, double t) const {
  const PrescribedState s = motion(y, t);
  return flight_.dynamics().kineticEnergy(insectMotion(insect_.beta, s.body, s.angles));
}

double LongitudinalFlight::potentialEnergy(const OdeState& y, double t) const {
  const PrescribedState s = motion(y, t);
  const Wing& hinge = insect_.wings.right;
  const double stretch = s.angles.wings.right.theta.q - hinge.theta_0;
  return flight_.dynamics().potentialEnergy(insectMotion(insect_.beta, s.body, s.angles)) +
         hinge.kappa * stretch * stretch;  // two springs
}

Loads smoothLoads(double frequency, double t) {
  const double p = 2.0 * M_PI * frequency * t;
  Loads loads;
  loads.force_pressure = {2e-4 * std::sin(p), 1e-4 * std::cos(2.0 * p),
                          -1.5e-3 - 8e-3 * std::sin(p + 0.4)};
  loads.moment_pressure = {-2.5e-4 * std::sin(p + 0.4), 3e-5 * std::cos(p),
                           1e-5 * std::sin(2.0 * p)};
  return loads;
}

}  // namespace monarch_flight::verify
