// The root finder of the trim on problems with known answers.
#include <gtest/gtest.h>

#include <cmath>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/trim/newton.h"

namespace monarch_flight {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void ignore(const NewtonResult&) {}

NewtonSettings settings(double low, double high) {
  NewtonSettings s;
  s.tolerance = 1e-10;
  s.difference = 1e-5;
  s.lower = VectorXd::Constant(1, low);
  s.upper = VectorXd::Constant(1, high);
  return s;
}

// atan: the full Newton step from 3 leads away, so this needs the line search.
std::optional<TrimResidual> arctan(const VectorXd& y) {
  return TrimResidual{VectorXd::Constant(1, std::atan(y(0) - 1.0)), VectorXd()};
}

TEST(TrimNewton, LineSearchConvergesWhereTheFullStepDiverges) {
  NewtonSettings s = settings(0, 0);
  s.max_step = 100.0;
  const NewtonResult r = solveTrim(arctan, VectorXd::Constant(1, 4.0), s, {}, ignore);
  EXPECT_TRUE(r.converged) << r.reason;
  EXPECT_NEAR(r.unknowns(0), 1.0, 1e-10);
}

TEST(TrimNewton, StepsAreBounded) {
  NewtonSettings s = settings(0, 0);
  s.max_step = 0.5;
  double last = 4.0, largest = 0.0;
  solveTrim(arctan, VectorXd::Constant(1, last), s, {}, [&](const NewtonResult& r) {
    largest = std::max(largest, std::abs(r.unknowns(0) - last));
    last = r.unknowns(0);
  });
  EXPECT_NEAR(last, 1.0, 1e-9);
  EXPECT_LE(largest, 0.5 + 1e-12);
}

TEST(TrimNewton, BroydenNeedsOneJacobian) {
  NewtonSettings s = settings(0, 0);
  s.broyden = true;
  s.max_iterations = 50;
  const auto f = [](const VectorXd& y) -> std::optional<TrimResidual> {
    return TrimResidual{
        (VectorXd(2) << y(0) * y(0) + y(1) - 3.0, y(1) * y(1) * y(1) - y(0)).finished(),
        VectorXd()};
  };
  const NewtonResult r = solveTrim(f, VectorXd::Constant(2, 1.5), s, {}, ignore);
  ASSERT_TRUE(r.converged) << r.reason;
  EXPECT_NEAR(std::pow(r.unknowns(1), 3), r.unknowns(0), 1e-9);
  EXPECT_LE(r.evaluations, 1 + 4 + 3 * r.iterations);
}

TEST(TrimNewton, BroydenLearnsNothingFromAFlightFarOff) {
  NewtonSettings s = settings(0, 0);
  s.broyden = true;
  s.max_halvings = 0;
  const MatrixXd given = 0.4 * MatrixXd::Identity(2, 2);  // its step falls below -0.5
  for (const double below : {1000.0, 2.0}) {
    const auto f = [below](const VectorXd& y) -> std::optional<TrimResidual> {
      return TrimResidual{y(0) < -0.5 ? VectorXd(below * y) : y, VectorXd()};
    };
    const NewtonResult r = solveTrim(f, VectorXd::Unit(2, 0), s, given, ignore);
    EXPECT_FALSE(r.converged);
    EXPECT_EQ(2, r.evaluations);
    EXPECT_EQ(below == 1000.0, r.jacobian == given);
  }
}

// State s with fixed point s = p (periodicity p - s), targets: s = 2, with p in its range.
std::optional<TrimResidual> follower(const VectorXd& y) {
  return TrimResidual{VectorXd::Constant(1, std::tanh(y(1) - y(0))),
                      VectorXd::Constant(1, y(0) * y(0) - 4.0)};
}

TEST(TrimNewton, ParametersMeetTheTarget) {
  const NewtonResult r =
      solveTrim(follower, VectorXd::Constant(2, 1.0), settings(0.0, 5.0), {}, ignore);
  ASSERT_TRUE(r.converged) << r.reason;
  EXPECT_NEAR(r.unknowns(0), 2.0, 1e-3);
  EXPECT_NEAR(r.unknowns(1), r.unknowns(0), 1e-9);
}

TEST(TrimNewton, ParametersStayInTheirRange) {
  for (const bool central : {true, false}) {
    NewtonSettings s = settings(0.0, 1.5);
    s.central = central;
    double largest = 0.0;  // parameter of any flight, those of the differences too
    const auto watched = [&](const VectorXd& y) {
      largest = std::max(largest, y(1));
      return follower(y);
    };
    const NewtonResult r = solveTrim(watched, VectorXd::Constant(2, 1.0), s, {}, ignore);
    ASSERT_TRUE(r.converged) << r.reason;
    EXPECT_NEAR(r.unknowns(1), 1.5, 1e-12);
    EXPECT_NEAR(r.unknowns(0), 1.5, 1e-9);
    EXPECT_LE(largest, 1.5 + 1e-12);
  }
}

TEST(TrimNewton, FailedFlightsAreAvoidedOrReported) {
  const auto cliff = [](const VectorXd& y) -> std::optional<TrimResidual> {
    if (y(0) < 0.5) return std::nullopt;  // the full step from 3 falls below
    return arctan(y);
  };
  NewtonSettings s = settings(0, 0);
  s.max_step = 100.0;
  EXPECT_TRUE(solveTrim(cliff, VectorXd::Constant(1, 4.0), s, {}, ignore).converged);
  EXPECT_THROW(solveTrim(cliff, VectorXd::Constant(1, 0.4), s, {}, ignore), NumericalError);
}

}  // namespace
}  // namespace monarch_flight
