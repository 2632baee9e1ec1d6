// Four coordinates (x, z, theta_B, theta_R) as the package solves them, against all 15 equations.
#include <random>

#include "dynamics/ode.h"
#include "dynamics/rows.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight::verify {
namespace {

using Eigen::Vector3d;

/// Random states of the size of a flight, from a fixed seed.
class Draw {
 public:
  double operator()(double size) { return size * uniform_(engine_); }
  Coordinate coordinate(double q, double qd, double qdd) {
    const double a = (*this)(q), b = (*this)(qd), c = (*this)(qdd);
    return {a, b, c};
  }
  Vector3d vector(double size) {
    const double a = (*this)(size), b = (*this)(size), c = (*this)(size);
    return {a, b, c};
  }

 private:
  std::mt19937 engine_{20};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

/// x', Omega' and both wings' theta'' from the 15 equations: the joints' other accelerations are
/// given, and the virtual work of the unknown joint torques vanishes along the free directions.
Eigen::Matrix<double, 8, 1> fullSystem(const Insect& insect, double gravity, BodyState body,
                                       JointAngles angles, const Loads& loads) {
  const MultibodyDynamics dynamics(insect, gravity);
  body.a.setZero();
  body.Omega_dot_B.setZero();
  for (Side side : kSides) angles.wings[side].theta.qdd = 0.0;
  const InsectMotion m = insectMotion(insect.beta, body, angles);
  Eigen::Matrix<double, 15, 8> free = Eigen::Matrix<double, 15, 8>::Zero();
  free.topLeftCorner<6, 6>().setIdentity();
  free(7, 6) = 1.0;   // Omega_R,y' holds theta_R''
  free(10, 7) = 1.0;  // Omega_L,y' holds theta_L''
  Vector15d rest =
      dynamics.airForce(m, {loads, loads}) + dynamics.gravityForce(m) - dynamics.inertialForce(m);
  const Wing& hinge = insect.wings.right;
  const double spring = -hinge.kappa * (angles.wings.right.theta.q - hinge.theta_0);
  rest(7) += spring;
  rest(10) += spring;
  const Eigen::MatrixXd J = free.transpose() * dynamics.inertia(m) * free;
  return J.ldlt().solve(free.transpose() * rest);
}

}  // namespace

DynamicsRows checkReducedForm(const DynamicsFolders& folders) {
  const Case c = loadCase("climb_printed", {}, folders.config);
  const FlightSolver flight(c.insect, c.gravity, kAllFree, Newmark());
  const WingPitchSolver wing(Side::kRight, c.insect, c.gravity, Newmark());
  Draw draw;
  constexpr int kStates = 200;
  Eigen::Vector4d scale = Eigen::Vector4d::Zero(), worst = Eigen::Vector4d::Zero();
  double out_of_plane = 0.0;
  for (int n = 0; n < kStates; ++n) {
    BodyState body;
    body.x = {draw(1.0), 0.0, draw(1.0)};
    body.v = {draw(2.0), 0.0, draw(2.0)};
    body = withPitch(body, draw.coordinate(1.0, 30.0, 0.0));
    const WingAngles own{draw.coordinate(1.2, 70.0, 5e3), draw.coordinate(0.2, 10.0, 1e3),
                         draw.coordinate(1.0, 60.0, 0.0)};
    const JointAngles angles{{own, own}, draw.coordinate(0.5, 20.0, 2e3)};
    Loads loads;
    loads.force_pressure = draw.vector(1e-2);
    loads.moment_pressure = draw.vector(3e-4);
    const Eigen::Vector4d a = coupledAccelerations(flight, wing, body, angles, loads);
    const auto full = fullSystem(c.insect, c.gravity, body, angles, loads);
    const Eigen::Vector4d b(full(0), full(2), full(4), full(6));
    scale = scale.cwiseMax(b.cwiseAbs());
    worst = worst.cwiseMax((a - b).cwiseAbs());
    const double side = std::max(
        {std::abs(full(1)), std::abs(full(6) - full(7)), std::abs(full(3)), std::abs(full(5))});
    out_of_plane = std::max(out_of_plane, side / b.norm());
  }
  const char* names[] = {"x''", "z''", "theta_B''", "theta_R''"};
  DynamicsRows rows;
  for (int i = 0; i < 4; ++i) {
    rows.push_back({"reduced", std::string(names[i]) + ", largest difference / largest",
                    std::to_string(kStates) + " random states", worst(i), scale(i),
                    worst(i) / scale(i), 1e-12});
  }
  rows.push_back({"reduced", "accelerations out of the plane of symmetry, relative",
                  std::to_string(kStates) + " random states", out_of_plane, 0.0, out_of_plane,
                  1e-12});
  return rows;
}

}  // namespace monarch_flight::verify
