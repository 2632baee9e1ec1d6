// Steps of the coupling against the same equations solved all at once.
#include <gtest/gtest.h>

#include "core/coupling_fakes.h"
#include "monarch_flight/flight/flight_solver.h"

namespace monarch_flight {
namespace {

using testing::both;
using testing::dimensionlessDistance;
using testing::Federation;
using testing::LinearAir;
using testing::monarchAir;

const FreeCoordinates kAllFree = {kX, kZ, kPitch, kThetaR};

/// All equations of a step at once: Newton on the generalised forces of the 15-velocity system,
/// rows x, z, pitch and right hinge; the left one does the same. Shares neither solvers nor loop
/// with the coordinator.
class Monolith {
 public:
  Monolith(const CoupledModel& model, const LinearAir& air)
      : model_(model), air_(air), dynamics_(model.insect, model.gravity) {}

  Interface step(const Interface& n, double t_n, double t) const {
    const Vector6d velocity_n = LinearAir::velocity(
        wingMotion(Side::kRight, model_.insect, n.body, motion_.at(t_n).anglesWith(n.theta)));
    Eigen::Vector4d a(n.body.a.x(), n.body.a.z(), n.body.pitch.qdd, n.theta.right.qdd);
    for (int newton = 0; newton < 6; ++newton) {
      const Eigen::Vector4d r = residual(n, velocity_n, t, a);
      Eigen::Matrix4d jacobian;
      for (int j = 0; j < 4; ++j) {
        const double h = j < 2 ? 1.0 : 100.0;
        Eigen::Vector4d shifted = a;
        shifted(j) += h;
        jacobian.col(j) = (residual(n, velocity_n, t, shifted) - r) / h;
      }
      a -= jacobian.fullPivLu().solve(r);
    }
    return at(n, t, a);
  }

 private:
  Interface at(const Interface& n, double t, const Eigen::Vector4d& a) const {
    Interface next = motion_.at(t).interface();
    BodyVector body = BodyVector::Zero();
    body(kX) = a(0);
    body(kZ) = a(1);
    body(kPitch) = a(2);
    next.body = advancedBody(n.body, next.body, model_.free, model_.newmark, body);
    next.theta = both(model_.newmark.advance(n.theta.right, a(3)));
    return next;
  }
  Eigen::Vector4d residual(const Interface& n, const Vector6d& velocity_n, double t,
                           const Eigen::Vector4d& a) const {
    const Interface next = at(n, t, a);
    const JointAngles angles = motion_.at(t).anglesWith(next.theta);
    const Loads loads =
        air_.law(velocity_n, wingMotion(Side::kRight, model_.insect, next.body, angles));
    const InsectMotion motion = insectMotion(model_.insect.beta, next.body, angles);
    Vector15d rest = dynamics_.inertialForce(motion) - dynamics_.gravityForce(motion) -
                     dynamics_.airForce(motion, both(loads));
    const Wing& wing = model_.insect.wings.right;
    rest(7) += wing.kappa * (next.theta.right.q - wing.theta_0);
    return {rest(0), rest(2), rest(4), rest(7)};
  }
  CoupledModel model_;
  testing::SineFlapping motion_;
  const LinearAir& air_;
  MultibodyDynamics dynamics_;
};

class AddedMass : public ::testing::TestWithParam<double> {};

/// Every committed step, seen from the level committed before.
TEST_P(AddedMass, StepsAreMonolithicWithinTheTolerance) {
  Federation f(testing::coupledModel(kAllFree, 200), testing::couplingSettings(),
               monarchAir(GetParam()));
  const CoupledOutcome outcome = f.run();
  ASSERT_TRUE(outcome.complete) << outcome.failure;
  const Monolith monolith(f.model, *f.air);
  for (std::uint32_t step = 11; step <= 200; ++step) {
    const Interface exact =
        monolith.step(f.sink.steps[step - 1].interface, f.model.time(step - 1), f.model.time(step));
    ASSERT_LT(dimensionlessDistance(f.sink.steps[step].interface, exact, f.settings.length_scale),
              1e-9)
        << "step " << step;
  }
}

/// The whole flight: errors of accelerations add up over the steps, so the tolerances are tight.
TEST_P(AddedMass, FlightIsTheMonolithicOne) {
  CouplingSettings settings = testing::couplingSettings();
  settings.tolerance = 1e-12;
  settings.load_tolerance = 1e-9;
  Federation f(testing::coupledModel(kAllFree, 200), settings, monarchAir(GetParam()));
  const CoupledOutcome outcome = f.run();
  ASSERT_TRUE(outcome.complete) << outcome.failure;
  ASSERT_EQ(f.sink.steps.size(), 201u);
  const Monolith monolith(f.model, *f.air);
  Interface exact = f.sink.steps[10].interface;
  for (std::uint32_t step = 11; step <= 200; ++step) {
    exact = monolith.step(exact, f.model.time(step - 1), f.model.time(step));
    ASSERT_LT(dimensionlessDistance(f.sink.steps[step].interface, exact, f.settings.length_scale),
              1e-8)
        << "step " << step;
  }
  // It has flown: the coordinates are far from the prescribed ones.
  const Interface prescribed = f.prescribed(f.model.time(200));
  EXPECT_GT(std::abs(exact.theta.right.q - prescribed.theta.right.q), 0.05);
  EXPECT_GT(std::abs(exact.body.pitch.q - prescribed.body.pitch.q), 0.005);
}

INSTANTIATE_TEST_SUITE_P(Ratios, AddedMass, ::testing::Values(0.0, 0.5, 1.0, 2.0, 5.0, 20.0));

}  // namespace
}  // namespace monarch_flight
