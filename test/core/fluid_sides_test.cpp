// A grid with few cells on one side of the wing: seen in a mirror, where they lie on the other
// side, it gives the same flow.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/fluid_flapping.h"
#include "fluid/flow.h"

namespace monarch_flight {
namespace {

constexpr double kDt = 0.005;

Axis uniform(int n) {
  std::vector<double> faces;
  for (int i = 0; i <= n; ++i) faces.push_back(0.1 * (i - n / 2));
  return Axis::fromFaces(std::move(faces));
}

/// `k_wing` cells below the wing's plane and six above, or the other way round.
Grid gridWith(int k_wing, bool open, bool image) {
  std::vector<double> z;
  for (int k = 0; k <= k_wing + 6; ++k) z.push_back(0.1 * (k - k_wing) * (k < k_wing ? 1.2 : 1.0));
  if (image) {
    std::reverse(z.begin(), z.end());
    for (double& face : z) face = 0.0 - face;
  }
  const int n = 16;
  std::vector<std::uint8_t> wing(n * n, 0);
  for (int j = 5; j < 13; ++j) {
    for (int i = 4; i < 10; ++i) wing[j * n + i] = 1;
  }
  return makeGrid(uniform(n), uniform(n), Axis::fromFaces(std::move(z)), image ? 6 : k_wing, open,
                  std::move(wing));
}

/// Across the wing's plane, and an inertial one.
WingMotion imageOf(WingMotion m) {
  const Eigen::Vector3d polar(1, 1, -1), axial(-1, -1, 1);
  m.r_I = polar.cwiseProduct(m.r_I);
  m.R_IW = polar.asDiagonal() * m.R_IW * polar.asDiagonal();
  for (Eigen::Vector3d* v : {&m.v_W, &m.a_W}) *v = polar.cwiseProduct(*v);
  for (Eigen::Vector3d* v : {&m.omega_W, &m.alpha_W}) *v = axial.cwiseProduct(*v);
  return m;
}

void expectNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const char* what, int step) {
  EXPECT_LT((a - b).norm(), 1e-10 * b.norm()) << what << ", step " << step;
}

class Sides : public ::testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(Sides, AFlowAndItsImageAreTheSame) {
  const auto [k_wing, open] = GetParam();
  NavierStokes flow(gridWith(k_wing, open, false), thinAir(), 0.6, 10);
  NavierStokes image(gridWith(k_wing, open, true), thinAir(), 0.6, 10);
  const Matrix6d M = flow.addedMass(), M_image = image.addedMass();
  EXPECT_NEAR(M(2, 2), M_image(2, 2), 1e-10 * M(2, 2));
  flow.start(flapping(0), kDt);
  image.start(imageOf(flapping(0)), kDt);
  for (int step = 1; step <= 8; ++step) {
    const WingMotion next = flapping(step * kDt);
    const Loads loads = flow.evaluate(next), other = image.evaluate(imageOf(next));
    const Eigen::Vector3d polar(1, 1, -1), axial(-1, -1, 1);
    expectNear(polar.cwiseProduct(other.force()), loads.force(), "force", step);
    expectNear(axial.cwiseProduct(other.moment()), loads.moment(), "moment", step);
    flow.commit();
    image.commit();
  }
  const Layout& l = flow.layout();
  double inside = 0.0, outside = 0.0;
  for (int j = 0; j < l.ny; ++j) {
    for (int i = 0; i < l.nx; ++i) {
      inside = std::max(inside, std::abs(flow.velocity().c[2][l.at(i, j, k_wing)]));
      for (int k : {0, l.nz})
        outside = std::max(outside, std::abs(flow.velocity().c[2][l.at(i, j, k)]));
    }
  }
  EXPECT_GT(inside, 0.1);
  if (!open) {
    EXPECT_EQ(outside, 0.0);  // no air through the closed ends
  }
}

INSTANTIATE_TEST_SUITE_P(CellsBelowAndOuter, Sides,
                         ::testing::Combine(::testing::Values(1, 2, 3), ::testing::Bool()));

}  // namespace
}  // namespace monarch_flight
