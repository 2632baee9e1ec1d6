#pragma once
// Insects and motions for the tests of flight, wing and coupling.
#include <cmath>
#include <random>

#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/insect/insect.h"

namespace monarch_flight {
namespace testing {

/// The same for both wings: a symmetric flight.
template <typename T>
PerWing<T> both(const T& one) {
  return {one, one};
}

/// Monarch of the published data set (github.com/fdcl-gwu/FWUAV, matlab/morp_MONARCH.m). The
/// planform is a rectangle of the same span and area: the dynamics only see masses and inertias.
inline Insect publishedMonarch() {
  Appendage right;
  right.m = 2.51e-05;
  right.nu = {-0.004437781694645591, 0.015176339407718576, 0.0};
  right.J << 2.756824953134474e-08, 2.4957003913366034e-09, 0.0, 2.4957003913366034e-09,
      2.579907487057571e-09, 0.0, 0.0, 0.0, 3.0148157018402314e-08;
  right.mu = {0.0, 0.00284, 0.0};
  Appendage abdomen;
  abdomen.m = 1.092e-4;
  abdomen.nu = {-0.00869, 0.0, 0.0};
  abdomen.J =
      Eigen::Vector3d(1.87879965e-10, 1.1089084142499997e-08, 1.1089084142499997e-08).asDiagonal();
  abdomen.mu = {-0.007315, 0.0, 0.0};
  const Wing wing{right, Planform::rectangle(0.0209048, 0.060997, 0.25), 4.07e-5, -0.2, {}};
  Insect insect{"published", false,   0.0,         Eigen::Matrix3d::Zero(),
                0.01463,     0.00568, 0.01738,     0.00371,
                abdomen,     0.4438,  {wing, wing}};
  insect.m_B = 1.485e-4;
  insect.J_B = Eigen::Vector3d(5.988708e-10, 2.9481420375e-09, 2.9481420375e-09).asDiagonal();
  return insect;
}

/// The same monarch with metres, kilograms and seconds of order one: lengths times 100, masses
/// times 1e4. The general identities hold for every insect, and numbers of order one make them
/// sharp.
inline Insect largeMonarch() {
  Insect insect = publishedMonarch();
  constexpr double kLength = 100.0, kMass = 1e4, kInertia = kMass * kLength * kLength;
  insect.m_B *= kMass;
  insect.J_B *= kInertia;
  for (Appendage* part : {&insect.wings.right.plate, &insect.wings.left.plate, &insect.abdomen}) {
    part->m *= kMass;
    part->nu *= kLength;
    part->J *= kInertia;
    part->mu *= kLength;
  }
  for (Side side : kSides) insect.wings[side].kappa = 1.7;
  return insect;
}

inline Coordinate wave(double mean, double amplitude, double rate, double phase, double t) {
  return {mean + amplitude * std::sin(rate * t + phase),
          amplitude * rate * std::cos(rate * t + phase),
          -amplitude * rate * rate * std::sin(rate * t + phase)};
}

/// Source of random numbers in [-1, 1] from a fixed seed.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()() { return uniform_(engine_); }
  Eigen::Vector3d vector() {
    const double a = (*this)(), b = (*this)(), c = (*this)();
    return {a, b, c};
  }
  Coordinate coordinate() {
    const double a = (*this)(), b = (*this)(), c = (*this)();
    return {a, b, c};
  }
  /// Symmetric.
  JointAngles angles() {
    const Coordinate phi = coordinate(), psi = coordinate(), theta = coordinate(), A = coordinate();
    return {both(WingAngles{phi, psi, theta}), A};
  }
  Loads loads() {
    const Eigen::Vector3d fp = vector(), ff = vector(), mp = vector(), mf = vector();
    return {fp, ff, mp, mf};
  }
  /// Any attitude and motion.
  BodyState body() {
    const WingAngles attitude = angles().wings.right;
    BodyState body;
    body.x = vector();
    body.v = vector();
    body.a = vector();
    body.q_IB = wingAttitude(Side::kRight, 0.0, attitude);
    body.Omega_B = wingRate(attitude);
    body.Omega_dot_B = wingRateDerivative(attitude);
    return body;
  }
  /// Pure pitch.
  BodyState pitchedBody() {
    const BodyState any = body();
    return withPitch(any, coordinate());
  }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

/// The 15 velocities of a motion.
inline Vector15d velocities(const InsectMotion& m) {
  Vector15d xi;
  xi << m.body.v, m.body.Omega_B, m.joints[0].Omega, m.joints[1].Omega, m.joints[2].Omega;
  return xi;
}

/// The 15 accelerations of a motion.
inline Vector15d accelerations(const InsectMotion& m) {
  Vector15d xi;
  xi << m.body.a, m.body.Omega_dot_B, m.joints[0].Omega_dot, m.joints[1].Omega_dot,
      m.joints[2].Omega_dot;
  return xi;
}

}  // namespace testing
}  // namespace monarch_flight
