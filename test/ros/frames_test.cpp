#include "monarch_flight/viz/frames.h"

#include <gtest/gtest.h>

#include <cmath>

#include "monarch_flight/math/rotation.h"
#include "monarch_flight/ros_io/flight_messages.h"

namespace monarch_flight {
namespace {

TEST(Frames, WorldIsEastNorthUp) {
  EXPECT_EQ(Eigen::Vector3d(2, 1, -3), nedToEnu() * Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(Eigen::Vector3d(1, -2, -3), frdToFlu() * Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(1.0, nedToEnu().determinant());
  EXPECT_EQ(1.0, frdToFlu().determinant());
}

TEST(Frames, NoseUpTurnsBaseLinkUpwards) {
  BodyState body;
  body.q_IB = rotationY(0.3);  // pitch up in x forward, y right, z down
  const Eigen::Vector3d nose = baseLinkAttitude(body) * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(0.0, nose.x(), 1e-15);            // east
  EXPECT_NEAR(std::cos(0.3), nose.y(), 1e-15);  // north
  EXPECT_NEAR(std::sin(0.3), nose.z(), 1e-15);  // up
}

TEST(Stamps, StartAtOneSecondAndDoNotDrift) {
  TimeGrid time;
  time.dt = 1.0 / 10.2 / 1000.0;
  EXPECT_EQ(ros::Time(1, 0), stampOf(0, time));
  // 10.2 million steps of 1/10200 s are 1000 s.
  EXPECT_EQ(ros::Time(1001, 0), stampOf(10200000, time));
  time.dt = 0.25;
  EXPECT_EQ(ros::Time(1, 750000000), stampOf(3, time));
}

}  // namespace
}  // namespace monarch_flight
