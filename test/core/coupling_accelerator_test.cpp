#include <gtest/gtest.h>

#include <cmath>

#include "monarch_flight/coupling/accelerator.h"

namespace monarch_flight {
namespace {

/// Iterates d = A d + b from 0 with a strategy; number of evaluations until |r| < tolerance, or
/// `limit`.
int evaluations(Accelerator& accelerator, const Eigen::Matrix4d& A, const Eigen::Vector4d& b,
                double tolerance, int limit, CouplingVector* solution = nullptr) {
  CouplingVector d = CouplingVector::Zero();
  for (int k = 1; k <= limit; ++k) {
    const CouplingVector residual = A * d + b - d;
    if (residual.cwiseAbs().maxCoeff() < tolerance) {
      if (solution != nullptr) *solution = d;
      return k;
    }
    accelerator.advance(d, residual);
  }
  return limit;
}

/// One coordinate is free, the others are prescribed: their residual is 0.
Eigen::Matrix4d scalar(double value) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A(0, 0) = value;
  return A;
}
const Eigen::Vector4d kScalarForce = Eigen::Vector4d::UnitX();

TEST(ConstantRelaxation, ContractsAsItsTheorySays) {
  // Error after k steps: (1 + omega (lambda - 1))^k.
  ConstantRelaxation accelerator(0.5);
  CouplingVector d = CouplingVector::Zero();
  const double lambda = -0.4, b = 1.0, solution = b / (1.0 - lambda);
  for (int k = 1; k <= 10; ++k) {
    CouplingVector residual = CouplingVector::Zero();
    residual(0) = lambda * d(0) + b - d(0);
    EXPECT_EQ(accelerator.advance(d, residual), 0.5);
    EXPECT_NEAR(d(0), solution * (1.0 - std::pow(1.0 + 0.5 * (lambda - 1.0), k)), 1e-15);
  }
}

TEST(Aitken, IsExactForAScalarAfterTwoSteps) {
  for (double lambda : {-8.0, -1.6, -0.3, 0.4, 0.9}) {
    AitkenRelaxation accelerator(0.5, 1e-6, 100.0);
    CouplingVector solution;
    EXPECT_EQ(evaluations(accelerator, scalar(lambda), kScalarForce, 1e-13, 50, &solution), 3)
        << lambda;
    EXPECT_NEAR(solution(0), 1.0 / (1.0 - lambda), 1e-13);
  }
}

TEST(Aitken, ConvergesWhereConstantRelaxationDiverges) {
  // Added mass 10.8 times the structure's: without relaxation the error grows tenfold each time.
  ConstantRelaxation plain(1.0), half(0.5);
  AitkenRelaxation aitken(0.5, 0.05, 1.5);
  EXPECT_EQ(evaluations(plain, scalar(-10.8), kScalarForce, 1e-10, 60), 60);
  EXPECT_EQ(evaluations(half, scalar(-10.8), kScalarForce, 1e-10, 60), 60);
  EXPECT_LE(evaluations(aitken, scalar(-10.8), kScalarForce, 1e-10, 60), 4);
}

TEST(Aitken, ConvergesForSeveralCoordinates) {
  Eigen::Matrix4d A;  // eigenvalues -1.6, -0.9, -0.4, -0.1, not normal
  A << -1.6, 0.3, 0.0, 0.5, 0.0, -0.9, 0.2, 0.0, 0.0, 0.0, -0.4, 0.1, 0.0, 0.0, 0.0, -0.1;
  const Eigen::Vector4d b(1.0, -2.0, 0.5, 3.0);
  AitkenRelaxation aitken(0.5, 0.05, 1.5);
  ConstantRelaxation plain(1.0);
  CouplingVector solution;
  EXPECT_LT(evaluations(aitken, A, b, 1e-10, 60, &solution), 40);
  EXPECT_LT((solution - (Eigen::Matrix4d::Identity() - A).inverse() * b).norm(), 1e-9);
  EXPECT_EQ(evaluations(plain, A, b, 1e-10, 60), 60);
}

TEST(Aitken, FirstFactorAndResetTakeTheInitialOne) {
  AitkenRelaxation accelerator(0.3, 0.05, 1.5);
  CouplingVector d = CouplingVector::Zero(), residual = CouplingVector::UnitX();
  EXPECT_EQ(accelerator.advance(d, residual), 0.3);
  residual(0) = 0.5;
  EXPECT_DOUBLE_EQ(accelerator.advance(d, residual), 0.6);
  accelerator.reset();
  EXPECT_EQ(accelerator.advance(d, residual), 0.3);
}

TEST(Aitken, StaysWithinItsBounds) {
  CouplingVector d = CouplingVector::Zero(), residual = CouplingVector::UnitX();
  AitkenRelaxation high(0.5, 0.05, 1.5);
  high.advance(d, residual);
  residual(0) = 0.99;  // would be 50
  EXPECT_EQ(high.advance(d, residual), 1.5);
  AitkenRelaxation low(0.5, 0.05, 1.5);
  residual(0) = 1.0;
  low.advance(d, residual);
  residual(0) = -99.0;  // would be 0.005
  EXPECT_EQ(low.advance(d, residual), 0.05);
  AitkenRelaxation negative(0.5, 0.05, 1.5);
  residual(0) = 1.0;
  negative.advance(d, residual);
  residual(0) = 1.01;  // a growing residual turns the sign: would be -50
  EXPECT_EQ(negative.advance(d, residual), -1.5);
}

TEST(Aitken, KeepsItsFactorWhenTheResidualDoesNotChange) {
  AitkenRelaxation accelerator(0.5, 0.05, 1.5);
  CouplingVector d = CouplingVector::Zero(), residual = CouplingVector::Ones();
  accelerator.advance(d, residual);
  EXPECT_EQ(accelerator.advance(d, residual), 0.5);
  EXPECT_TRUE(d.allFinite());
}

TEST(Settings, NameTheStrategy) {
  CouplingSettings settings;
  settings.relaxation = Relaxation::kConstant;
  EXPECT_NE(dynamic_cast<ConstantRelaxation*>(makeAccelerator(settings).get()), nullptr);
  settings.relaxation = Relaxation::kAitken;
  EXPECT_NE(dynamic_cast<AitkenRelaxation*>(makeAccelerator(settings).get()), nullptr);
}

TEST(Settings, EveryFaultAtOnce) {
  EXPECT_TRUE(CouplingSettings().problems().empty());
  CouplingSettings bad;
  bad.omega_initial = 0.0;
  bad.omega_min = -1.0;
  bad.omega_max = NAN;
  bad.tolerance = 0.0;
  bad.load_tolerance = 2.0;
  bad.max_sub_iterations = 0;
  bad.prescribed_steps = -1;
  bad.length_scale = -0.02;
  const auto faults = bad.problems();
  EXPECT_EQ(faults.size(), 8u);
  EXPECT_NE(faults[0].find("coupling/omega_initial = 0: must be in (0, 1]"), std::string::npos);
  CouplingSettings crossed;
  crossed.omega_min = 0.9;
  crossed.omega_max = 0.8;
  EXPECT_EQ(crossed.problems().size(), 1u);
}

TEST(Newmark, IsExactForConstantAcceleration) {
  Newmark newmark;
  newmark.dt = 0.1;
  const Coordinate next = newmark.advance({1.0, 2.0, 3.0}, 3.0);
  EXPECT_DOUBLE_EQ(next.q, 1.0 + 0.2 + 0.5 * 3.0 * 0.01);
  EXPECT_DOUBLE_EQ(next.qd, 2.3);
  EXPECT_EQ(next.qdd, 3.0);
  newmark.beta = 1.0 / 6.0;  // linear acceleration: exact for a jerk of 10
  EXPECT_DOUBLE_EQ(newmark.advance({1.0, 2.0, 3.0}, 4.0).q, 1.0 + 0.2 + 0.015 + 10.0 / 6.0 * 1e-3);
}

}  // namespace
}  // namespace monarch_flight
