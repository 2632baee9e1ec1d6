#include <gtest/gtest.h>

#include <cmath>

#include "core/coupling_fakes.h"
#include "monarch_flight/coupling/accelerator.h"

namespace monarch_flight {
namespace {

/// Advances d in place; returns the factor applied.
double advance(Accelerator& accelerator, CouplingVector& d, const CouplingVector& residual) {
  Trial trial;
  trial.d = d;
  trial.residual = residual;
  const Proposal next = accelerator.advance(trial);
  d = next.d;
  return next.relaxation;
}

/// Iterates d = A d + b from `start` with a strategy; number of evaluations until |r| < tolerance,
/// or `limit`.
int evaluations(Accelerator& accelerator, const CoordinateMatrix& A, const CouplingVector& b,
                double tolerance, int limit, CouplingVector* solution = nullptr,
                const CouplingVector& start = CouplingVector::Zero()) {
  CouplingVector d = start;
  accelerator.beginStep(1);
  for (int k = 1; k <= limit; ++k) {
    Trial trial;
    trial.d = d;
    trial.residual = A * d + b - d;
    if (trial.residual.cwiseAbs().maxCoeff() < tolerance) {
      if (solution != nullptr) *solution = d;
      accelerator.endStep(trial);
      return k;
    }
    d = accelerator.advance(trial).d;
  }
  return limit;
}

/// Four coordinates are free, those of a symmetric flight; the others are prescribed: their
/// residual is 0.
constexpr FreeCoordinate kFour[4] = {kX, kZ, kPitch, kThetaR};
CoordinateMatrix ofFour(const Eigen::Matrix4d& A) {
  CoordinateMatrix all = CoordinateMatrix::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) all(kFour[i], kFour[j]) = A(i, j);
  }
  return all;
}
CouplingVector ofFour(const Eigen::Vector4d& b) {
  CouplingVector all = CouplingVector::Zero();
  for (int i = 0; i < 4; ++i) all(kFour[i]) = b(i);
  return all;
}

/// One coordinate is free.
CoordinateMatrix scalar(double value) {
  CoordinateMatrix A = CoordinateMatrix::Zero();
  A(0, 0) = value;
  return A;
}
const CouplingVector kScalarForce = CouplingVector::Unit(0);

TEST(ConstantRelaxation, ContractsAsItsTheorySays) {
  // Error after k steps: (1 + omega (lambda - 1))^k.
  ConstantRelaxation accelerator(0.5);
  CouplingVector d = CouplingVector::Zero();
  const double lambda = -0.4, b = 1.0, solution = b / (1.0 - lambda);
  for (int k = 1; k <= 10; ++k) {
    CouplingVector residual = CouplingVector::Zero();
    residual(0) = lambda * d(0) + b - d(0);
    EXPECT_EQ(advance(accelerator, d, residual), 0.5);
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
  Eigen::Matrix4d four;  // eigenvalues -1.6, -0.9, -0.4, -0.1, not normal
  four << -1.6, 0.3, 0.0, 0.5, 0.0, -0.9, 0.2, 0.0, 0.0, 0.0, -0.4, 0.1, 0.0, 0.0, 0.0, -0.1;
  const CoordinateMatrix A = ofFour(four);
  const CouplingVector b = ofFour(Eigen::Vector4d(1.0, -2.0, 0.5, 3.0));
  AitkenRelaxation aitken(0.5, 0.05, 1.5);
  ConstantRelaxation plain(1.0);
  CouplingVector solution;
  EXPECT_LT(evaluations(aitken, A, b, 1e-10, 60, &solution), 40);
  EXPECT_LT((solution - (CoordinateMatrix::Identity() - A).inverse() * b).norm(), 1e-9);
  EXPECT_EQ(evaluations(plain, A, b, 1e-10, 60), 60);
}

TEST(Aitken, FirstFactorAndResetTakeTheInitialOne) {
  AitkenRelaxation accelerator(0.3, 0.05, 1.5);
  CouplingVector d = CouplingVector::Zero(), residual = CouplingVector::Unit(0);
  EXPECT_EQ(advance(accelerator, d, residual), 0.3);
  residual(0) = 0.5;
  EXPECT_DOUBLE_EQ(advance(accelerator, d, residual), 0.6);
  accelerator.beginStep(1);
  EXPECT_EQ(advance(accelerator, d, residual), 0.3);
}

TEST(Aitken, StaysWithinItsBounds) {
  CouplingVector d = CouplingVector::Zero(), residual = CouplingVector::Unit(0);
  AitkenRelaxation high(0.5, 0.05, 1.5);
  advance(high, d, residual);
  residual(0) = 0.99;  // would be 50
  EXPECT_EQ(advance(high, d, residual), 1.5);
  AitkenRelaxation low(0.5, 0.05, 1.5);
  residual(0) = 1.0;
  advance(low, d, residual);
  residual(0) = -99.0;  // would be 0.005
  EXPECT_EQ(advance(low, d, residual), 0.05);
  AitkenRelaxation negative(0.5, 0.05, 1.5);
  residual(0) = 1.0;
  advance(negative, d, residual);
  residual(0) = 1.01;  // a growing residual turns the sign: would be -50
  EXPECT_EQ(advance(negative, d, residual), -1.5);
}

TEST(Aitken, KeepsItsFactorWhenTheResidualDoesNotChange) {
  AitkenRelaxation accelerator(0.5, 0.05, 1.5);
  CouplingVector d = CouplingVector::Zero(), residual = CouplingVector::Ones();
  advance(accelerator, d, residual);
  EXPECT_EQ(advance(accelerator, d, residual), 0.5);
  EXPECT_TRUE(d.allFinite());
}

/// Not normal; eigenvalues -10.8, -1.6, -0.9, -0.4: an added mass ten times the structure's.
CoordinateMatrix heavyAir() {
  Eigen::Matrix4d A;
  A << -10.8, 0.3, 0.0, 0.5, 0.0, -1.6, 0.2, 0.0, 0.0, 0.0, -0.9, 0.1, 0.0, 0.0, 0.0, -0.4;
  return ofFour(A);
}
const CouplingVector kForce = ofFour(Eigen::Vector4d(1.0, -2.0, 0.5, 3.0));

TEST(IqnIls, SolvesALinearProblemOfFourUnknownsInSix) {
  // The start, one relaxed trial, then each difference spans one more direction.
  IqnIls accelerator(0.1, 0);
  CouplingVector solution;
  EXPECT_LE(evaluations(accelerator, heavyAir(), kForce, 1e-10, 60, &solution), 6);
  EXPECT_LT((solution - (CoordinateMatrix::Identity() - heavyAir()).inverse() * kForce).norm(),
            1e-9);
}

TEST(IqnIls, ReuseMakesTheNextStepImmediate) {
  IqnIls reusing(0.1, 2), fresh(0.1, 0);
  for (IqnIls* accelerator : {&reusing, &fresh}) {
    evaluations(*accelerator, heavyAir(), kForce, 1e-10, 60);
  }
  const CouplingVector next = ofFour(Eigen::Vector4d(0.7, -1.0, 1.5, -3.0));
  EXPECT_EQ(evaluations(reusing, heavyAir(), next, 1e-9, 60), 2);
  EXPECT_GT(evaluations(fresh, heavyAir(), next, 1e-9, 60), 4);
  reusing.forget();
  EXPECT_GT(evaluations(reusing, heavyAir(), next, 1e-9, 60), 4);
}

TEST(IqnIls, OldDifferencesGo) {
  IqnIls accelerator(0.1, 1);
  evaluations(accelerator, heavyAir(), kForce, 1e-10, 60);
  const CouplingVector solved = (CoordinateMatrix::Identity() - heavyAir()).inverse() * kForce;
  // Two steps that begin at their solution teach nothing and outlive the memory.
  EXPECT_EQ(evaluations(accelerator, heavyAir(), kForce, 1e-9, 60, nullptr, solved), 1);
  EXPECT_EQ(evaluations(accelerator, heavyAir(), kForce, 1e-9, 60, nullptr, solved), 1);
  EXPECT_GT(evaluations(accelerator, heavyAir(), -kForce, 1e-9, 60), 4);
}

TEST(IqnIls, PrescribedCoordinatesAndRepeatedResidualsDoNoHarm) {
  IqnIls accelerator(0.5, 3);
  EXPECT_LE(evaluations(accelerator, scalar(-10.8), kScalarForce, 1e-12, 60), 3);
  CouplingVector d = CouplingVector::Zero(), residual = CouplingVector::Ones();
  accelerator.forget();
  accelerator.beginStep(1);
  advance(accelerator, d, residual);
  EXPECT_EQ(advance(accelerator, d, residual), 0.5);  // the same residual again: nothing learnt
  EXPECT_TRUE(d.allFinite());
}

TEST(Settings, NameTheStrategy) {
  const StepModel model(testing::coupledModel({kX, kZ, kPitch, kThetaR}, 1), 0.02);
  const auto names = [&](Relaxation relaxation, auto* type) {
    CouplingSettings settings;
    settings.relaxation = relaxation;
    return dynamic_cast<decltype(type)>(makeAccelerator(settings, model).get()) != nullptr;
  };
  EXPECT_TRUE(names(Relaxation::kConstant, static_cast<ConstantRelaxation*>(nullptr)));
  EXPECT_TRUE(names(Relaxation::kAitken, static_cast<AitkenRelaxation*>(nullptr)));
  EXPECT_TRUE(names(Relaxation::kIqnIls, static_cast<IqnIls*>(nullptr)));
  EXPECT_TRUE(names(Relaxation::kAddedMass, static_cast<AddedMassNewton*>(nullptr)));
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
  bad.reuse_steps = 21;
  bad.operator_every = 0;
  bad.length_scale = -0.02;
  const auto faults = bad.problems();
  EXPECT_EQ(faults.size(), 10u);
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
