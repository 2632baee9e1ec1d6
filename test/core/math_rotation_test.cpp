#include <gtest/gtest.h>

#include <random>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRound = 1e-15;

Vector3d randomAxis(std::mt19937& engine) {
  std::normal_distribution<double> normal;
  const double a = normal(engine), b = normal(engine), c = normal(engine);
  return Vector3d(a, b, c).normalized();
}

/// Distance of R from SO(3).
double defect(const Matrix3d& R) {
  return (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff() +
         std::abs(R.determinant() - 1.0);
}

TEST(Rotation, HatIsTheCrossProductAndVeeItsInverse) {
  const Vector3d a(1.0, -2.0, 3.0), b(0.5, 4.0, -1.0);
  EXPECT_EQ(hat(a) * b, a.cross(b));
  EXPECT_EQ(vee(hat(a)), a);
  EXPECT_EQ(hat(a).transpose(), -hat(a));
}

TEST(Rotation, ExpOfZeroIsTheIdentity) {
  EXPECT_EQ(expSO3(Vector3d::Zero()), Matrix3d::Identity());
  EXPECT_EQ(logSO3(Matrix3d::Identity()), Vector3d::Zero());
}

TEST(Rotation, AxisRotationsAreExponentials) {
  for (double angle : {0.0, 1e-12, 0.3, -2.0, M_PI - 1e-9}) {
    EXPECT_TRUE(rotationX(angle).isApprox(expSO3({angle, 0, 0}), kRound)) << angle;
    EXPECT_TRUE(rotationY(angle).isApprox(expSO3({0, angle, 0}), kRound)) << angle;
    EXPECT_TRUE(rotationZ(angle).isApprox(expSO3({0, 0, angle}), kRound)) << angle;
  }
  // Right-handed: a quarter turn about x takes y to z.
  EXPECT_TRUE((rotationX(M_PI / 2) * Vector3d::UnitY()).isApprox(Vector3d::UnitZ(), kRound));
  EXPECT_TRUE((rotationY(M_PI / 2) * Vector3d::UnitZ()).isApprox(Vector3d::UnitX(), kRound));
  EXPECT_TRUE((rotationZ(M_PI / 2) * Vector3d::UnitX()).isApprox(Vector3d::UnitY(), kRound));
}

TEST(Rotation, ExpIsOrthonormalAtEveryAngle) {
  std::mt19937 engine(1);
  for (double angle :
       {0.0, 1e-300, 1e-12, 1e-8, 9.9e-5, 1.01e-4, 0.1, 1.0, 3.0, M_PI - 1e-9, M_PI, 20.0}) {
    for (int i = 0; i < 50; ++i)
      EXPECT_LT(defect(expSO3(angle * randomAxis(engine))), 1e-14) << angle;
  }
}

TEST(Rotation, QuaternionsAreThoseOfTheMatrices) {
  std::mt19937 engine(5);
  for (double angle : {0.0, 1e-9, 0.9e-4, 1.1e-4, 0.3, 3.0, 6.0}) {
    const Vector3d a = angle * randomAxis(engine);
    const Quaternion q = expQuaternion(a);
    EXPECT_NEAR(q.norm(), 1.0, kRound) << angle;
    EXPECT_LT((rotationOf(q) - expSO3(a)).norm(), 3e-15) << angle;
    EXPECT_LT((rotationOf(quaternionX(angle)) - rotationX(angle)).norm(), 3e-15) << angle;
    EXPECT_LT((rotationOf(quaternionY(angle)) - rotationY(angle)).norm(), 3e-15) << angle;
    EXPECT_LT((rotationOf(quaternionZ(angle)) - rotationZ(angle)).norm(), 3e-15) << angle;
  }
}

TEST(Rotation, LogInvertsExpAtEveryAngle) {
  std::mt19937 engine(2);
  for (double angle :
       {1e-300, 1e-12, 1e-8, 9.9e-5, 1.01e-4, 0.1, 1.0, 3.0, M_PI - 1e-6, M_PI - 1e-9}) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d a = angle * randomAxis(engine);
      // Relative accuracy for small angles, absolute to rounding for large ones.
      EXPECT_LT((logSO3(expSO3(a)) - a).norm(), 3e-15 * std::max(angle, angle > 0.1 ? 1.0 : 0.0))
          << angle;
    }
  }
}

TEST(Rotation, LogOfAHalfTurnHasLengthPi) {
  std::mt19937 engine(3);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d R = expSO3(M_PI * randomAxis(engine));
    EXPECT_NEAR(logSO3(R).norm(), M_PI, 1e-15);
    EXPECT_LT((expSO3(logSO3(R)) - R).norm(), 1e-14);
  }
}

TEST(Rotation, GroupLaws) {
  std::mt19937 engine(4);
  for (int i = 0; i < 100; ++i) {
    const Vector3d axis = randomAxis(engine);
    const Matrix3d A = expSO3(1.7 * randomAxis(engine)), B = expSO3(0.4 * axis);
    // Inverse, one-parameter subgroup, invariance of the cross product, conjugation.
    EXPECT_LT((expSO3(-0.4 * axis) - B.transpose()).norm(), kRound);
    EXPECT_LT((expSO3(0.9 * axis) * B - expSO3(1.3 * axis)).norm(), 2e-15);
    EXPECT_LT((hat(A * axis) - A * hat(axis) * A.transpose()).norm(), 4e-15);
    EXPECT_LT((A * B * A.transpose() - expSO3(0.4 * (A * axis))).norm(), 4e-15);
  }
}

TEST(Rotation, OrthonormalisedIsTheClosestRotation) {
  std::mt19937 engine(5);
  const Matrix3d R = expSO3(2.1 * randomAxis(engine));
  // R S with S symmetric and positive has R as its polar factor, the closest rotation.
  Matrix3d S;
  S << 1.01, 0.02, 0.0, 0.02, 0.98, -0.01, 0.0, -0.01, 1.03;
  EXPECT_LT((orthonormalised(R * S) - R).norm(), 3e-15);
  EXPECT_LT(defect(orthonormalised(R * S)), 3e-15);
  EXPECT_LT((orthonormalised(R) - R).norm(), 3e-15);
  // A reflection is mapped to a rotation all the same.
  EXPECT_NEAR(orthonormalised(Eigen::Vector3d(1.0, 1.0, -0.5).asDiagonal()).determinant(), 1.0,
              1e-15);
}

TEST(Errors, EveryFaultOnItsOwnLine) {
  EXPECT_STREQ(InputError(std::vector<std::string>{"a = 1: must be 2", "b = 3: must be 4"}).what(),
               "a = 1: must be 2\nb = 3: must be 4");
  EXPECT_STREQ(InputError("one").what(), "one");
}

}  // namespace
}  // namespace monarch_flight
