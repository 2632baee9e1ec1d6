// The direct pressure solver: its algebra against the operator and a dense solve, its order against
// a smooth solution.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "monarch_flight/fluid/pressure_solver.h"

namespace monarch_flight {
namespace {

using Field = Eigen::VectorXd;
using Shape = std::function<bool(double, double)>;

/// n cells on [low, high], stretched by `skew` (asymmetric) or `squeeze` (symmetric), both in [0,
/// 1).
Axis axisOf(int n, double low, double high, double skew, double squeeze) {
  std::vector<double> face(n + 1);
  for (int i = 0; i <= n; ++i) {
    const double s = static_cast<double>(i) / n;
    const double t =
        s + 0.5 * skew * s * (1.0 - s) + squeeze / (2.0 * M_PI) * std::sin(2.0 * M_PI * s);
    face[i] = low + (high - low) * t;
  }
  face.back() = high;
  return Axis::fromFaces(face);
}

struct GridCase {
  const char* name;
  int nx, ny;
  double skew_x, skew_y;  ///< 0: symmetric
  Shape wing;
};

const Shape kNone = [](double, double) { return false; };
const Shape kDisc = [](double x, double y) { return std::hypot(x, y) < 0.8; };
const Shape kEll = [](double x, double y) {
  return std::abs(x) < 0.9 && std::abs(y) < 0.9 && !(x > 0.1 && y > -0.2);
};
const Shape kTwoPieces = [](double x, double y) {
  return std::hypot(x - 1, y) < 0.5 || std::hypot(x + 1, y - 0.5) < 0.4;
};

Grid gridOf(const GridCase& c, bool open) {
  Axis x = axisOf(c.nx, -2.0, 2.0, c.skew_x, 0.4), y = axisOf(c.ny, -1.5, 1.5, c.skew_y, 0.3);
  const Axis below = axisOf(6, -1.0, 0.0, 0.2, 0.0), above = axisOf(9, 0.0, 1.4, 0.0, 0.2);
  std::vector<double> z = below.face;
  z.insert(z.end(), above.face.begin() + 1, above.face.end());
  std::vector<std::uint8_t> wing;
  for (double yc : y.centre) {
    for (double xc : x.centre) wing.push_back(c.wing(xc, yc));
  }
  return makeGrid(std::move(x), std::move(y), Axis::fromFaces(z), 6, open, std::move(wing));
}

Field randomRight(const Grid& grid, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  Field b(grid.cells());
  for (double& v : b) v = normal(engine);
  if (!grid.open) b.array() -= b.mean();
  return b;
}

Field volumes(const Grid& grid) {
  Field v(grid.cells());
  long c = 0;
  for (double dz : grid.z.width) {
    for (double dy : grid.y.width) {
      for (double dx : grid.x.width) v[c++] = dx * dy * dz;
    }
  }
  return v;
}

/// The operator as the header defines it, face by face, written independently of the library.
Eigen::MatrixXd denseOperator(const Grid& g) {
  const int n[3] = {g.x.n(), g.y.n(), g.z.n()};
  const Axis* axes[3] = {&g.x, &g.y, &g.z};
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(g.cells(), g.cells());
  auto index = [&](const int* c) { return (static_cast<long>(c[2]) * n[1] + c[1]) * n[0] + c[0]; };
  int c[3];
  for (c[2] = 0; c[2] < n[2]; ++c[2]) {
    for (c[1] = 0; c[1] < n[1]; ++c[1]) {
      for (c[0] = 0; c[0] < n[0]; ++c[0]) {
        for (int d = 0; d < 3; ++d) {
          const double area =
              axes[(d + 1) % 3]->width[c[(d + 1) % 3]] * axes[(d + 2) % 3]->width[c[(d + 2) % 3]];
          for (int side : {-1, 1}) {
            int other[3] = {c[0], c[1], c[2]};
            other[d] += side;
            const int face = c[d] + (side + 1) / 2;
            int beyond[3] = {c[0], c[1], c[2]};
            beyond[d] = face;
            const bool outside = face == 0 || face == n[d];
            const double mobility = outside ? 1 : g.mobility.at(d, beyond[0], beyond[1], beyond[2]);
            const bool outer = other[d] < 0 || other[d] == n[d];
            if (outer && !g.open) continue;
            const double distance =
                outer ? 0.5 * axes[d]->width[c[d]]
                      : std::abs(axes[d]->centre[other[d]] - axes[d]->centre[c[d]]);
            a(index(c), index(c)) -= mobility * area / distance;
            if (!outer) a(index(c), index(other)) += mobility * area / distance;
          }
        }
      }
    }
  }
  return a;
}

class Solve : public testing::TestWithParam<std::tuple<GridCase, bool>> {
 protected:
  Grid grid_ = gridOf(std::get<0>(GetParam()), std::get<1>(GetParam()));
};

TEST_P(Solve, SatisfiesTheEquationsToRounding) {
  const PressureSolver solver(grid_);
  EXPECT_EQ(solver.wingFaces(), std::count(grid_.wing.begin(), grid_.wing.end(), 1));
  for (unsigned seed : {1u, 2u}) {
    const Field b = randomRight(grid_, seed);
    Field p = b, back(b.size());
    solver.solve(p.data());
    solver.apply(p.data(), back.data());
    EXPECT_LE((back - b).norm(), 1e-11 * b.norm());
    if (!grid_.open) {
      EXPECT_LE(std::abs(volumes(grid_).dot(p)), 1e-11 * p.norm());
    }
  }
}

TEST_P(Solve, OperatorIsTheOneOfTheHeader) {
  const PressureSolver solver(grid_);
  const Field p = randomRight(grid_, 3);
  Field y(p.size());
  solver.apply(p.data(), y.data());
  const Field expected = denseOperator(grid_) * p;
  EXPECT_LE((y - expected).norm(), 1e-13 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(
    Grids, Solve,
    testing::Combine(testing::Values(GridCase{"no_wing", 16, 14, 0, 0, kNone},
                                     GridCase{"disc", 16, 14, 0, 0, kDisc},
                                     GridCase{"disc_skew_x", 16, 14, 0.6, 0, kDisc},
                                     GridCase{"disc_skew_y", 16, 14, 0, 0.6, kDisc},
                                     GridCase{"disc_skew_both", 15, 13, 0.6, 0.5, kDisc},
                                     GridCase{"disc_odd_counts", 15, 13, 0, 0, kDisc},
                                     GridCase{"ell", 16, 14, 0, 0, kEll},
                                     GridCase{"two_pieces", 16, 13, 0, 0, kTwoPieces}),
                     testing::Bool()),
    [](const auto& info) {
      return std::string(std::get<0>(info.param).name) +
             (std::get<1>(info.param) ? "_open" : "_rest");
    });

class OddWing : public testing::TestWithParam<bool> {};

TEST_P(OddWing, OneFaceAnywhereAndAllButOneAreSolved) {
  const GridCase base{"", 8, 6, 0, 0.4, kNone};
  for (bool inverted : {false, true}) {
    for (std::size_t face : {0u, 7u, 20u, 47u}) {
      std::size_t next = 0;
      GridCase one_face = base;
      one_face.wing = [&](double, double) { return (next++ == face) != inverted; };
      const Grid grid = gridOf(one_face, GetParam());
      const PressureSolver solver(grid);
      const Field b = randomRight(grid, 5);
      Field p = b, back(b.size());
      solver.solve(p.data());
      solver.apply(p.data(), back.data());
      EXPECT_LE((back - b).norm(), 1e-11 * b.norm()) << inverted << " " << face;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Outer, OddWing, testing::Bool());

TEST(PressureSolver, RefusesAWingThatCutsAClosedBoxInTwo) {
  const GridCase whole{"", 8, 6, 0, 0, [](double, double) { return true; }};
  EXPECT_THROW(PressureSolver{gridOf(whole, false)}, std::invalid_argument);
  EXPECT_NO_THROW(PressureSolver{gridOf(whole, true)});
}

TEST(PressureSolver, AgreesWithADenseSolve) {
  for (bool open : {false, true}) {
    for (double skew : {0.0, 0.5}) {
      const Grid grid = gridOf({"", 8, 6, skew, 0.0, kEll}, open);
      const Field b = randomRight(grid, 7), volume = volumes(grid);
      Field p = b;
      PressureSolver(grid).solve(p.data());
      Field expected = denseOperator(grid).completeOrthogonalDecomposition().solve(b);
      if (!open) expected.array() -= volume.dot(expected) / volume.sum();
      EXPECT_LE((p - expected).norm(), 1e-11 * expected.norm()) << open << " " << skew;
    }
  }
}

TEST(PressureSolver, RemovesTheMeanOfAnUnbalancedRightSideOfAClosedBox) {
  const Grid grid = gridOf({"", 8, 6, 0, 0.3, kDisc}, false);
  const PressureSolver solver(grid);
  const Field balanced = randomRight(grid, 8), volume = volumes(grid);
  Field p = balanced, q = balanced + 0.3 / volume.sum() * volume;
  solver.solve(p.data());
  solver.solve(q.data());
  EXPECT_LE((p - q).norm(), 1e-12 * p.norm());
}

TEST(PressureSolver, RepeatsBitForBit) {
  const Grid grid = gridOf({"", 16, 14, 0, 0, kDisc}, false);
  const PressureSolver solver(grid), second(grid);
  const Field b = randomRight(grid, 9);
  Field p = b, q = b, r = b;
  solver.solve(p.data());
  solver.solve(q.data());
  second.solve(r.data());
  EXPECT_EQ(p, q);
  EXPECT_EQ(p, r);
}

/// Largest error against a smooth solution without wing, n cells a side on stretched axes.
double smoothError(int n, bool open) {
  const double kx = M_PI / 2.0, ky = M_PI, kz = M_PI / 1.5;
  Axis x = axisOf(n, 0.0, 2.0, 0.5, 0.0), y = axisOf(n, 0.0, 1.0, 0.0, 0.4);
  Axis z = axisOf(n, -0.5, 1.0, 0.0, 0.0);
  const int k_wing = n / 3;  // z.face = -0.5 + 1.5 k / n: zero for n divisible by 3
  z.face[k_wing] = 0.0;
  Grid grid = makeGrid(std::move(x), std::move(y), Axis::fromFaces(z.face), k_wing, open,
                       std::vector<std::uint8_t>(static_cast<std::size_t>(n) * n, 0));
  auto exact = [&](double a, double b, double c) {
    return open ? std::sin(kx * a) * std::sin(ky * b) * std::sin(kz * (c + 0.5))
                : std::cos(kx * a) * std::cos(ky * b) * std::cos(kz * (c + 0.5));
  };
  const Field volume = volumes(grid);
  Field p(grid.cells()), truth(grid.cells());
  long at = 0;
  for (double c : grid.z.centre) {
    for (double b : grid.y.centre) {
      for (double a : grid.x.centre) truth[at++] = exact(a, b, c);
    }
  }
  p = -(kx * kx + ky * ky + kz * kz) * truth.cwiseProduct(volume);
  PressureSolver(grid).solve(p.data());
  if (!open) truth.array() -= volume.dot(truth) / volume.sum();
  return (p - truth).lpNorm<Eigen::Infinity>();
}

TEST(PressureSolver, IsOfSecondOrderOnStretchedAxes) {
  for (bool open : {false, true}) {
    const double coarse = smoothError(12, open), fine = smoothError(24, open);
    const double finest = smoothError(48, open);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.2) << open;
    EXPECT_NEAR(std::log2(fine / finest), 2.0, 0.1) << open;
    EXPECT_LT(finest, 2e-3) << open;
  }
}

}  // namespace
}  // namespace monarch_flight
