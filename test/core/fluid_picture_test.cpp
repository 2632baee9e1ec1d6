// The block of points that pictures of the flow are made of, against flows known everywhere.
#include <gtest/gtest.h>

#include <cmath>

#include "core/fluid_flapping.h"
#include "fluid/flow/flow.h"

namespace monarch_flight::fluid {
namespace {

using Eigen::Vector3d;

Axis uniform(double half, int n) {
  std::vector<double> faces;
  for (int i = 0; i <= n; ++i) faces.push_back(half * (2.0 * i / n - 1.0));
  return Axis::fromFaces(faces);
}

/// Without a wing, at rest, in a flow that is known; chord 1.
FlowPicture pictureOf(const KnownFlow& known, std::size_t limit) {
  constexpr int kCells = 40;
  const Axis axis = uniform(2.0, kCells);
  NavierStokes flow(makeGrid(axis, axis, axis, kCells / 2, false,
                             std::vector<std::uint8_t>(std::size_t{kCells} * kCells, 0)),
                    thinAir(), 1.0, 100.0);
  flow.start(WingMotion(), 0.01);
  flow.setKnownFlow(known);
  return flow.flowPicture(limit);
}

template <class Check>
void forEachPoint(const FlowPicture& p, Check check) {
  std::size_t n = 0;
  for (std::uint32_t k = 0; k < p.size[2]; ++k)
    for (std::uint32_t j = 0; j < p.size[1]; ++j)
      for (std::uint32_t i = 0; i < p.size[0]; ++i, ++n)
        check(n, Vector3d(p.origin[0], p.origin[1], p.origin[2]) +
                     double(p.spacing) * Vector3d(i, j, k));
}

TEST(FlowPicture, OfAirThatTurnsAsASolidHasItsRate) {
  const double rate = 3.0;
  const FlowPicture p = pictureOf(
      [&](const Vector3d& r, double) { return Vector3d(rate * r.z(), 0, -rate * r.x()); }, 20000);
  ASSERT_GT(p.points(), 5000u);
  ASSERT_EQ(p.points(), p.omega_y.size());
  for (std::size_t n = 0; n < p.points(); ++n) {
    ASSERT_NEAR(p.step * p.q_root[n], rate, 2.0 * p.step);
    ASSERT_NEAR(p.step * p.omega_y[n], 2.0 * rate, 2.0 * p.step);
  }
}

TEST(FlowPicture, HasItsPointsWhereItSays) {
  const double a = 2.0, b = -1.0, c = 0.7;
  const FlowPicture p = pictureOf(
      [&](const Vector3d& r, double) {
        return Vector3d(0.5 * a * r.z() * r.z() + c * r.y() * r.z(), 0, 0.5 * b * r.x() * r.x());
      },
      20000);
  forEachPoint(p, [&](std::size_t n, const Vector3d& r) {
    ASSERT_NEAR(p.step * p.omega_y[n], a * r.z() + c * r.y() - b * r.x(), 1e-3) << r.transpose();
  });
}

TEST(FlowPicture, KeepsItsLimitAndLiesAroundTheWing) {
  const auto flow = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid());
  flow->start(flapping(0), 0.005);
  std::size_t before = 0;
  for (std::size_t limit : {std::size_t{8}, std::size_t{1000}, std::size_t{30000}}) {
    const FlowPicture p = flow->flowPicture(limit);
    EXPECT_LE(p.points(), limit);
    EXPECT_GT(p.points(), before);
    EXPECT_EQ(p.points(), std::size_t{p.size[0]} * p.size[1] * p.size[2]);
    EXPECT_EQ(p.size[2] % 2, 0u);
    EXPECT_NEAR(p.origin[2], -0.5f * p.spacing * static_cast<float>(p.size[2] - 1), 1e-6);
    before = p.points();
  }
  const FlowPicture p = flow->flowPicture(30000);
  EXPECT_LT(p.origin[0], -1.0f);  // the ellipse lies from -0.7 to 0.3, 0 to 2
  EXPECT_GT(p.origin[1] + p.spacing * static_cast<float>(p.size[1]), 2.5f);
}

TEST(FlowPicture, OfTheLeftWingIsTurnedIntoItsTrueAxesAndBack) {
  FlowPicture p;
  p.origin = {1, 2, 3};
  p.spacing = 0.5f;
  p.size = {2, 3, 2};
  for (std::int16_t n = 0; n < 12; ++n) {
    p.q_root.push_back(n);
    p.omega_y.push_back(static_cast<std::int16_t>(100 + n));
  }
  const FlowPicture image = mirrored(p);
  EXPECT_EQ(image.origin, (std::array<float, 3>{1, -3, 3}));
  EXPECT_EQ(image.q_root, (std::vector<std::int16_t>{4, 5, 2, 3, 0, 1, 10, 11, 8, 9, 6, 7}));
  EXPECT_EQ(image.omega_y[0], 104);
  EXPECT_EQ(mirrored(image).q_root, p.q_root);
  EXPECT_EQ(mirrored(image).origin, p.origin);
}

}  // namespace
}  // namespace monarch_flight::fluid
