// The body as seen in axes that turn with its heading.
#include <gtest/gtest.h>

#include <cmath>

#include "monarch_flight/insect/heading.h"
#include "monarch_flight/insect/start_motion.h"

namespace monarch_flight {
namespace {

Coordinate wave(double t, double mean, double size, double w, double phase) {
  const double a = w * t + phase;
  return {mean + size * std::sin(a), size * w * std::cos(a), -size * w * w * std::sin(a)};
}

/// A body that turns about all three axes and moves.
BodyState flown(double t) {
  BodyState body;
  for (int i = 0; i < 3; ++i) {
    const Coordinate c = wave(t, 0.1 * i, 0.3, 3.0 + i, 0.4 * i);
    body.x(i) = c.q;
    body.v(i) = c.qd;
    body.a(i) = c.qdd;
  }
  return withAngles(body, wave(t, 0.2, 0.5, 5.0, 0.1), wave(t, 0.3, 0.4, 4.0, 1.0),
                    wave(t, 2.0, 0.7, 2.0, 0.7));
}

TEST(HeadingMotion, AnglesAndTheirDerivativesAreThoseOfTheMotion) {
  for (double t : {0.0, 0.13, 0.7, 1.9}) {
    const HeadingMotion m = headingMotion(flown(t));
    const Coordinate roll = wave(t, 0.2, 0.5, 5.0, 0.1), yaw = wave(t, 2.0, 0.7, 2.0, 0.7);
    for (const auto& [got, want] : {std::pair{m.roll, roll}, {m.yaw, yaw}}) {
      EXPECT_NEAR(got.q, want.q, 1e-13);
      EXPECT_NEAR(got.qd, want.qd, 1e-12);
      EXPECT_NEAR(got.qdd, want.qdd, 1e-11);
    }
  }
}

TEST(HeadingMotion, VelocityTurnsWithTheHeading) {
  constexpr double kStep = 1e-5, t = 0.6;
  const HeadingMotion before = headingMotion(flown(t - kStep)), now = headingMotion(flown(t)),
                      after = headingMotion(flown(t + kStep));
  EXPECT_NEAR(now.velocity.norm(), flown(t).v.norm(), 1e-14);
  EXPECT_LT(((after.velocity - before.velocity) / (2.0 * kStep) - now.velocity_dot).norm(), 1e-8);
  const double yaw = now.yaw.q;
  const Eigen::Vector3d forward(std::cos(yaw), std::sin(yaw), 0.0);
  EXPECT_NEAR(now.velocity.x(), flown(t).v.dot(forward), 1e-14);
}

TEST(HeadingMotion, APitchingBodyHeadsNorthHoweverFarItPitches) {
  BodyState body;
  body.v = {-0.4, 0.0, 0.3};
  for (double pitch : {0.3, 2.0, -4.0}) {
    const HeadingMotion m = headingMotion(withPitch(body, {pitch, 5.0, 7.0}));
    EXPECT_EQ(m.yaw.q, 0.0);
    EXPECT_EQ(m.roll.q, 0.0);
    EXPECT_EQ(m.pitch.q, pitch);
    EXPECT_TRUE(m.velocity == body.v);
  }
}

}  // namespace
}  // namespace monarch_flight
