// The matrix of the wing's faces by tiles: its inverse and products against those of Eigen.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "fluid/pressure/blas.h"
#include "fluid/pressure/shared_symmetric.h"

namespace monarch_flight::fluid::pressure {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Random, the first `positive` rows and columns positive definite, the others negative definite.
MatrixXd quasiDefinite(int rows, int positive) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> between(-1, 1);
  const MatrixXd any = MatrixXd::NullaryExpr(rows, rows, [&] { return between(random); });
  MatrixXd matrix = any + any.transpose();
  for (int i = 0; i < rows; ++i) matrix(i, i) = (i < positive ? 2.5 : -2.5) * rows;
  return matrix;
}

SymmetricTiles tilesOf(const MatrixXd& matrix, int positive) {
  const int rows = static_cast<int>(matrix.rows());
  SymmetricTiles tiles(rows, positive);
  for (int c = 0; c < rows; ++c) {
    for (int r = c; r < rows; ++r) tiles.column(c)[r] = matrix(r, c);
  }
  return tiles;
}

class Tiles : public ::testing::TestWithParam<std::pair<int, int>> {};

TEST_P(Tiles, TheInverseTimesTheMatrixIsOne) {
  const auto [rows, positive] = GetParam();
  const MatrixXd matrix = quasiDefinite(rows, positive);
  const BlasUse blas(3);  // one thread in BLAS itself
  MatrixXd first;
  for (int threads : {1, 2, 3}) {
    SymmetricTiles tiles = tilesOf(matrix, positive);
    tiles.invert(Team(threads));
    const SharedSymmetric inverse(std::move(tiles), Slab(4), 2, Team(threads));
    MatrixXd product(rows, rows);
    for (int c = 0; c < rows; ++c) inverse.multiply(matrix.col(c).eval().data(), &product(0, c));
    EXPECT_LT((product - MatrixXd::Identity(rows, rows)).cwiseAbs().maxCoeff(), 1e-13);
    if (threads == 1) first = product;
    EXPECT_EQ(product, first) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(RowsAndPositive, Tiles,
                         ::testing::Values(std::pair(1, 1), std::pair(3, 2), std::pair(20, 20),
                                           std::pair(75, 60), std::pair(203, 1),
                                           std::pair(310, 250)));

TEST(Tiles, TakeLittleMoreThanTheTriangle) {
  SymmetricTiles tiles(1000, 800);
  long entries = 0;
  for (int t = 0; t < tiles.panels(); ++t) entries += long(tiles.width(t)) * tiles.leading(t);
  EXPECT_LT(entries, 600000);
}

TEST(Tiles, AMatrixOfAnotherKindIsRefused) {
  SymmetricTiles tiles = tilesOf(quasiDefinite(40, 30), 35);
  const BlasUse blas;
  EXPECT_THROW(tiles.invert(Team()), std::runtime_error);
  SymmetricTiles infinite = tilesOf(quasiDefinite(40, 30), 30);
  infinite.column(3)[5] = NAN;
  EXPECT_THROW(infinite.invert(Team()), std::runtime_error);
}

}  // namespace
}  // namespace monarch_flight::fluid::pressure
