#include "monarch_flight/flight/flight_solver.h"

#include <gtest/gtest.h>

#include "core/test_insect.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"
#include "monarch_flight/wing/wing_pitch_solver.h"

namespace monarch_flight {
namespace {

using Eigen::Vector3d;
using testing::both;
using testing::Random;

constexpr double kGravity = 9.81;
const FreeCoordinates kBodyFree = {kX, kZ, kPitch};
const PerWing<Loads> kNoAir;

/// Accelerations with Lagrange multipliers: all 15 equations, the prescribed accelerations as
/// constraints.
Vector15d constrainedAccelerations(const MultibodyDynamics& dynamics, const InsectMotion& motion,
                                   const PerWing<Loads>& loads, const std::vector<int>& free_rows) {
  Eigen::Matrix<double, 30, 30> system = Eigen::Matrix<double, 30, 30>::Zero();
  Eigen::Matrix<double, 30, 1> right = Eigen::Matrix<double, 30, 1>::Zero();
  system.topLeftCorner<15, 15>() = dynamics.inertia(motion);
  right.head<15>() =
      dynamics.airForce(motion, loads) + dynamics.gravityForce(motion) - dynamics.bias(motion);
  const Vector15d known = testing::accelerations(motion);
  for (int row = 0; row < 15; ++row) {
    const bool is_free = std::count(free_rows.begin(), free_rows.end(), row) > 0;
    system(row, 15 + row) = is_free ? 0.0 : -1.0;
    system(15 + row, is_free ? 15 + row : row) = 1.0;
    right(15 + row) = is_free ? 0.0 : known(row);
  }
  return Eigen::FullPivLU<Eigen::Matrix<double, 30, 30>>(system).solve(right).head<15>();
}

TEST(FlightSolver, ReducedFormEqualsTheFullSystem) {
  const Insect insect = testing::largeMonarch();
  const MultibodyDynamics dynamics(insect, kGravity);
  Random random(21);
  for (unsigned mask = 0; mask < 64; ++mask) {
    FreeCoordinates free;
    std::vector<int> rows;  // the body's coordinates are the first of the 15 velocities
    for (int i = 0; i < 6; ++i) {
      free[static_cast<std::size_t>(i)] = (mask >> i & 1u) != 0;
      if (free[static_cast<std::size_t>(i)]) rows.push_back(i);
    }
    const FlightSolver solver(insect, kGravity, free, Newmark());
    for (int i = 0; i < 30; ++i) {
      const bool symmetric = i % 2 == 0;
      const BodyState body = symmetric ? random.pitchedBody() : random.body();
      JointAngles angles = random.angles();
      PerWing<Loads> loads = both(random.loads());
      if (!symmetric) {
        angles.wings.left = random.angles().wings.left;
        loads.left = random.loads();
      }
      const Vector15d expected =
          constrainedAccelerations(dynamics, insectMotion(insect.beta, body, angles), loads, rows);
      const BodyVector found = solver.accelerations(body, angles, loads);
      EXPECT_LT((found - expected.head<6>()).norm(), 1e-12 * expected.norm());
    }
  }
}

/// The unknown accelerations may not depend on their guess.
TEST(FlightSolver, ForgetsTheGuessedAccelerations) {
  const FlightSolver solver(testing::largeMonarch(), kGravity, kBodyFree, Newmark());
  Random random(22);
  BodyState body = random.pitchedBody();
  const JointAngles angles = random.angles();
  const PerWing<Loads> loads = both(random.loads());
  const BodyVector first = solver.accelerations(body, angles, loads);
  body.a.x() += 3.0;
  body.a.z() -= 2.0;
  body = withPitch(body, {body.pitch.q, body.pitch.qd, 7.0});
  EXPECT_EQ(solver.accelerations(body, angles, loads), first);
}

TEST(FlightSolver, PrescribedCoordinatesAreTakenFromTheMotion) {
  Newmark newmark;
  newmark.dt = 0.01;
  Random random(23);
  const BodyState n = random.pitchedBody(), prescribed = random.pitchedBody();
  const FlightSolver solver(testing::largeMonarch(), kGravity, {kZ}, newmark);
  const JointAngles angles = random.angles();
  const BodyState next = solver.step(n, prescribed, prescribed, angles, both(random.loads()));
  EXPECT_EQ(next.x.x(), prescribed.x.x());
  EXPECT_EQ(next.x.y(), prescribed.x.y());
  EXPECT_EQ(next.R_IB(), prescribed.R_IB());
  EXPECT_EQ(next.Omega_dot_B, prescribed.Omega_dot_B);
  const Coordinate z = newmark.advance({n.x.z(), n.v.z(), n.a.z()}, next.a.z());
  EXPECT_EQ(next.x.z(), z.q);
  EXPECT_EQ(next.v.z(), z.qd);
  EXPECT_NE(next.a.z(), prescribed.a.z());
}

TEST(FlightSolver, RefusesWhatItCannotDo) {
  Insect bare = testing::largeMonarch();
  bare.bare_wing = true;
  EXPECT_THROW(FlightSolver(bare, kGravity, {kX}, Newmark()), InputError);
  EXPECT_NO_THROW(FlightSolver(bare, kGravity, {kThetaR}, Newmark()));

  const FlightSolver solver(testing::largeMonarch(), kGravity, kBodyFree, Newmark());
  BodyState rolled;
  rolled.q_IB = rotationX(0.1);
  EXPECT_THROW(solver.step(rolled, rolled, rolled, JointAngles(), kNoAir), InputError);

  Insect massless = testing::largeMonarch();
  massless.m_B = massless.abdomen.m = 0.0;
  for (Side side : kSides) massless.wings[side].plate.m = 0.0;
  EXPECT_THROW(FlightSolver(massless, kGravity, {kX}, Newmark())
                   .accelerations(BodyState(), JointAngles(), kNoAir),
               NumericalError);
}

/// Flight of an insect without air: flight and wing solver iterated to the implicit Newmark step.
class Vacuum {
 public:
  Vacuum(const Insect& insect, double gravity, double dt, bool passive, bool flapping)
      : insect_(insect), passive_(passive), flapping_(flapping) {
    newmark_.dt = dt;
    flight_.emplace(insect, gravity, kBodyFree, newmark_);
    wing_.emplace(Side::kRight, insect, gravity, newmark_);
    body_.v = {0.8, 0.0, -0.5};
    body_ = withPitch(body_, {0.3, flapping ? 0.4 : 0.0, 0.0});
    theta_ = {0.2, passive ? 1.0 : 0.0, 0.0};
    angles_ = prescribed(0.0);
    for (int i = 0; i < 60; ++i) solveAccelerations();  // consistent accelerations at the start
  }

  void step() {
    t_ += newmark_.dt;
    const BodyState n = body_;
    const Coordinate theta_n = theta_;
    for (int i = 0; i < 200; ++i) {
      angles_ = prescribed(t_);
      if (passive_) theta_ = wing_->step(theta_n, body_, angles_, Loads());
      angles_ = prescribed(t_);
      const BodyState next = flight_->step(n, n, body_, angles_, kNoAir);
      const double change = (next.a - body_.a).norm() + std::abs(next.pitch.qdd - body_.pitch.qdd);
      body_ = next;
      if (change < 1e-13 * (1.0 + next.a.norm() + std::abs(next.pitch.qdd))) return;
    }
    FAIL() << "the step does not converge";
  }

  InsectMotion motion() const { return insectMotion(insect_.beta, body_, angles_); }
  const MultibodyDynamics& dynamics() const { return flight_->dynamics(); }
  double t() const { return t_; }
  const BodyState& body() const { return body_; }

  double energy() const {
    const double spring = hinge().kappa * std::pow(theta().q - hinge().theta_0, 2);
    return dynamics().kineticEnergy(motion()) + dynamics().potentialEnergy(motion()) +
           (passive_ ? spring : 0.0);  // both hinges
  }
  /// Power of the joints, without that of the hinges' springs [W].
  double musclePower() const {
    const InsectMotion m = motion();
    const auto torque = dynamics().jointTorques(m, kNoAir);
    double power = 0.0;
    for (std::size_t i = 0; i < 3; ++i) power += torque[i].dot(m.joints[i].Omega);
    const double spring = -hinge().kappa * (theta().q - hinge().theta_0);
    return power - (passive_ ? 2.0 * spring * theta().qd : 0.0);
  }

 private:
  const Wing& hinge() const { return insect_.wings.right; }
  const Coordinate& theta() const { return angles_.wings.right.theta; }
  JointAngles prescribed(double t) const {
    if (!flapping_) return {both(WingAngles{{0.2, 0, 0}, {0.1, 0, 0}, theta_}), {0.3, 0, 0}};
    const Coordinate theta = passive_ ? theta_ : testing::wave(0.1, 0.6, 6.0, 1.5, t);
    const WingAngles wing{testing::wave(0.1, 0.9, 6.0, 0.4, t),
                          testing::wave(0.0, 0.1, 12.0, 1.0, t), theta};
    return {both(wing), testing::wave(0.3, 0.2, 6.0, 2.5, t)};
  }
  void solveAccelerations() {
    const BodyVector a = flight_->accelerations(body_, angles_, kNoAir);
    body_.a = {a(kX), 0.0, a(kZ)};
    body_ = withPitch(body_, {body_.pitch.q, body_.pitch.qd, a(kPitch)});
    if (passive_) theta_.qdd = wing_->acceleration(body_, angles_, Loads());
    angles_ = prescribed(0.0);
  }

  Insect insect_;
  Newmark newmark_;
  bool passive_, flapping_;
  std::optional<FlightSolver> flight_;
  std::optional<WingPitchSolver> wing_;
  BodyState body_;
  Coordinate theta_;
  JointAngles angles_;
  double t_ = 0.0;
};

TEST(FreeFall, IsExact) {
  Vacuum fall(testing::publishedMonarch(), kGravity, 1e-3, false, false);
  const Vector3d start = fall.dynamics().massCentre(fall.motion());
  for (int i = 0; i < 1000; ++i) fall.step();
  const double t = fall.t();
  EXPECT_NEAR(fall.body().x.x(), 0.8 * t, 1e-12);
  EXPECT_NEAR(fall.body().x.z(), -0.5 * t + 0.5 * kGravity * t * t, 1e-12);
  EXPECT_NEAR(fall.body().pitch.q, 0.3, 1e-12);
  EXPECT_NEAR(fall.body().v.z(), -0.5 + kGravity * t, 1e-12);
  const Vector3d path = fall.dynamics().massCentre(fall.motion()) - start;
  EXPECT_NEAR(path.z(), -0.5 * t + 0.5 * kGravity * t * t, 1e-12);
}

struct Errors {
  double linear = 0.0, angular = 0.0, energy = 0.0;  // largest over the flight
};

/// Largest departures from the conservation laws over one second (about one flap).
Errors departures(bool passive, double gravity, int steps) {
  Vacuum flight(testing::largeMonarch(), gravity, 1.0 / steps, passive, true);
  const MultibodyDynamics& dynamics = flight.dynamics();
  const double mass = testing::largeMonarch().totalMass();
  const Vector3d P = dynamics.linearMomentum(flight.motion());
  const double L = dynamics.angularMomentum(flight.motion()).y();
  const double E = flight.energy();
  double impulse_moment = 0.0, work = 0.0;
  auto weight_moment = [&] { return -mass * gravity * dynamics.massCentre(flight.motion()).x(); };
  Errors errors;
  for (int i = 0; i < steps; ++i) {
    const double moment = weight_moment(), power = flight.musclePower();
    flight.step();
    impulse_moment += 0.5 / steps * (moment + weight_moment());
    work += 0.5 / steps * (power + flight.musclePower());
    const InsectMotion motion = flight.motion();
    const Vector3d weight = mass * gravity * flight.t() * Vector3d::UnitZ();
    errors.linear = std::max(errors.linear, (dynamics.linearMomentum(motion) - P - weight).norm());
    errors.angular = std::max(errors.angular,
                              std::abs(dynamics.angularMomentum(motion).y() - L - impulse_moment));
    errors.energy = std::max(errors.energy, std::abs(flight.energy() - E - work));
  }
  return errors;
}

class Conservation : public ::testing::TestWithParam<std::tuple<bool, double>> {};

/// Every departure is the integrator's alone: it vanishes with the square of the time step.
TEST_P(Conservation, HoldsToTheOrderOfTheIntegrator) {
  const auto [passive, gravity] = GetParam();
  const Errors coarse = departures(passive, gravity, 400),
               fine = departures(passive, gravity, 1600);
  EXPECT_NEAR(coarse.linear / fine.linear, 16.0, 1.6);
  EXPECT_NEAR(coarse.angular / fine.angular, 16.0, 1.6);
  EXPECT_NEAR(coarse.energy / fine.energy, 16.0, 1.6);
  EXPECT_LT(fine.linear, 1e-3);
  EXPECT_LT(fine.angular, 1e-3);
  EXPECT_LT(fine.energy, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(PrescribedAndPassive, Conservation,
                         ::testing::Combine(::testing::Bool(), ::testing::Values(0.0, kGravity)));

}  // namespace
}  // namespace monarch_flight
