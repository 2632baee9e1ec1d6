// What is made of the flow for rviz, without a node: clouds of pressure, markers of wings, vortices
// and forces.
#include "monarch_flight/viz/flow_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "monarch_flight/ros_io/flight_messages.h"
#include "monarch_flight/viz/force_arrows.h"
#include "monarch_flight/viz/pressure_cloud.h"
#include "ros/flow_samples.h"

namespace monarch_flight {
namespace {

using visualization_msgs::Marker;

/// Field `name` of point i.
float number(const sensor_msgs::PointCloud2& cloud, std::size_t i, const std::string& name) {
  for (const sensor_msgs::PointField& field : cloud.fields) {
    if (field.name != name) continue;
    float value;
    std::memcpy(&value, cloud.data.data() + i * cloud.point_step + field.offset, sizeof value);
    return value;
  }
  ADD_FAILURE() << "no field " << name;
  return 0.0f;
}

TEST(PressureCloud, HasAPointAFacetInTheTrueAxesOfTheWing) {
  const ros::Time stamp(3, 4);
  const auto right = pressureCloud(surface(5.0f), Side::kRight, stamp);
  const auto left = pressureCloud(surface(5.0f), Side::kLeft, stamp);
  EXPECT_EQ("right_wing", right.header.frame_id);
  EXPECT_EQ("left_wing", left.header.frame_id);
  EXPECT_EQ(stamp, left.header.stamp);
  EXPECT_EQ(2u, left.width);
  const std::map<std::string, float> expected = {
      {"x", -0.01f},  {"y", 0.02f},      {"z", 0.0f},         {"dx", 0.002f},
      {"dy", 0.004f}, {"p_upper", 5.0f}, {"p_lower", -10.0f}, {"jump", 15.0f}};
  for (const auto& [name, value] : expected) {
    EXPECT_EQ(value, number(right, 0, name)) << name;
    EXPECT_EQ(name == "y" ? -value : value, number(left, 0, name)) << name;
  }
  EXPECT_EQ(-5.0f, number(right, 1, "jump"));
}

TEST(PressureCloud, GivesTheSurfaceBackAndRefusesOtherClouds) {
  for (Side side : kSides) {
    auto cloud = pressureCloud(surface(5.0f), side, ros::Time(1, 0));
    const auto back = surfacePressure(cloud, side);
    ASSERT_TRUE(back);
    const SurfacePressure same = surface(5.0f);
    ASSERT_EQ(2u, back->facets.size());
    EXPECT_EQ(0, std::memcmp(same.facets.data(), back->facets.data(),
                             2 * sizeof(SurfacePressure::Facet)));
    auto other = cloud;
    other.fields[5].name = "p";
    EXPECT_FALSE(surfacePressure(other, side));
    other = cloud;
    other.data.pop_back();
    EXPECT_FALSE(surfacePressure(other, side));
  }
}

TEST(PublishedPressure, OfIndependentWingsIsTheirOwnAndOfMirroredOnesTheRightOne) {
  CommittedStep step;
  step.step = 10;
  step.surface = {surface(5.0f), surface(7.0f)};
  for (const std::string wings : {"mirrored", "independent"}) {
    FlightMessages messages(caseWith(wings));
    std::map<std::string, sensor_msgs::PointCloud2> clouds;
    for (const StampedMessage& m : messages.of(step)) {
      const auto* cloud = std::get_if<sensor_msgs::PointCloud2>(&m.message);
      if (cloud != nullptr) clouds[m.topic] = *cloud;
    }
    ASSERT_EQ(wings == "mirrored" ? 1u : 2u, clouds.size());
    EXPECT_EQ(5.0f, number(clouds.at(RunNames().topic(topics::kRightPressure)), 0, "p_upper"));
    if (wings == "independent") {
      EXPECT_EQ(7.0f, number(clouds.at(RunNames().topic(topics::kLeftPressure)), 0, "p_upper"));
    }
  }
}

TEST(WingSheet, StaysWithinTheOutlineAndReachesItsEdges) {
  const Planform wing = caseWith("mirrored").insect.wings.right.planform;
  const WingSheet sheet(wing, 20, 7);
  for (int i = 0; i < 20; ++i) {
    const double y = sheet.at(i, 0).y();
    EXPECT_NEAR(sheet.at(i, 0).x(), wing.trailing(y), 1e-12);
    EXPECT_NEAR(sheet.at(i, 6).x(), wing.leading(y), 1e-12);
  }
  EXPECT_NEAR(sheet.at(19, 3).y(), wing.yTip(), 1e-12);
}

/// Facets of 1 mm on a rectangle, with a pressure that is a function of the place.
template <class Pressure>
SurfacePressure facets(Pressure pressure) {
  SurfacePressure out;
  for (int j = 0; j < 30; ++j) {
    for (int i = 0; i < 20; ++i) {
      const float x = 1e-3f * (static_cast<float>(i) - 9.5f),
                  y = 1e-3f * (static_cast<float>(j) + 0.5f);
      const float p = static_cast<float>(pressure(x, y));
      out.facets.push_back({x, y, 1e-3f, 1e-3f, p, -p});
    }
  }
  return out;
}

TEST(FacetMeans, KeepAConstantAndALinearPressureAndAreSmooth) {
  const auto linear = [](double x, double y) { return 3.0 + 200.0 * x - 100.0 * y; };
  const SurfacePressure other = surface(1.0f);
  const SurfacePressure surface = facets(linear);
  std::vector<Eigen::Vector2d> inside, beyond;
  for (int i = 0; i < 50; ++i) inside.emplace_back(1e-4 * (i - 25), 0.01 + 2e-4 * i);
  beyond = {{0.0, 0.031}, {0.2, 0.2}};
  const FacetMeans means(surface, inside);
  const std::vector<double> p = means.of(surface, &SurfacePressure::Facet::p_upper);
  for (std::size_t i = 0; i < inside.size(); ++i)
    EXPECT_NEAR(p[i], linear(inside[i].x(), inside[i].y()), 0.01);  // a facet's step is 0.2
  const SurfacePressure constant = facets([](double, double) { return 7.0; });
  for (double value : FacetMeans(constant, beyond).of(constant, &SurfacePressure::Facet::p_lower))
    EXPECT_NEAR(value, -7.0, 1e-6);
  EXPECT_TRUE(means.fits(constant));
  EXPECT_FALSE(means.fits(other));
}

TEST(WingPressure, ColoursBothSidesOfAWingWithinItsOutline) {
  const Case c = caseWith("mirrored");
  WingPressure wing(c, Side::kRight);
  const auto p = static_cast<float>(0.3 * pressureReference(c).dynamic);
  wing.take({{{0.0f, 0.03f, 0.02f, 0.06f, p, -2.0f * p}}});
  EXPECT_NEAR(wing.largest(), 0.6, 1e-6);
  const Marker right = wing.marker(Side::kRight, 1.0, {2, 0});
  const Marker left = wing.marker(Side::kLeft, 1.0, {2, 0});
  EXPECT_EQ("right_wing", right.header.frame_id);
  EXPECT_EQ("left_wing", left.header.frame_id);
  ASSERT_EQ(right.points.size(), right.colors.size());
  ASSERT_EQ(right.points.size(), left.points.size());
  const Planform& outline = c.insect.wings.right.planform;
  for (std::size_t i = 0; i < right.points.size(); ++i) {
    const auto& at = right.points[i];
    EXPECT_EQ(at.y, -left.points[i].y);
    EXPECT_LE(at.x, outline.leading(at.y) + 1e-6);
    EXPECT_GE(at.x, outline.trailing(at.y) - 1e-6);
    EXPECT_NEAR(pressureColour(at.z < 0.0 ? 0.3 : -0.6).r, right.colors[i].r, 1e-6);  // dorsal: -z
  }
}

TEST(ScaleLimit, IsRoundHoldsTheLargestAndForgets) {
  ScaleLimit limit(3);
  EXPECT_EQ(1.0, limit.value());
  limit.add(0.0);
  EXPECT_EQ(1.0, limit.value());
  limit.add(1.9);
  EXPECT_DOUBLE_EQ(2.0, limit.value());
  limit.add(40.0);
  EXPECT_DOUBLE_EQ(50.0, limit.value());
  for (int i = 0; i < 3; ++i) limit.add(0.012);
  EXPECT_DOUBLE_EQ(0.015, limit.value());
}

TEST(ForceArrows, StandAtTheCentreOfPressureAndMirror) {
  const Case c = caseWith("mirrored");
  Loads loads;
  loads.force_pressure = {0.0, 0.0, -2e-3};
  loads.moment_pressure = Eigen::Vector3d(-0.004, 0.02, 0.0).cross(loads.force_pressure);
  const auto arrows = forceArrows(c, {loads, loads}, {0, 0, -4e-3}, {1, 2, 3}, {2, 0}).markers;
  ASSERT_EQ(3u, arrows.size());
  EXPECT_NEAR(arrows[0].points[0].x, -0.004, 1e-9);
  EXPECT_NEAR(arrows[0].points[0].y, 0.02, 1e-9);
  EXPECT_NEAR(arrows[1].points[0].y, -0.02, 1e-9);
  EXPECT_LT(arrows[0].points[1].z, 0.0);
  EXPECT_EQ("world_ned", arrows[2].header.frame_id);
  const double weight = c.insect.totalMass() * c.gravity,
               span = c.insect.wings.right.planform.span();
  EXPECT_NEAR(arrows[2].points[1].z - 3.0, -4e-3 * span / (2.0 * weight), 1e-9);
}

TEST(Vortices, AreSurfacesAroundThemWithNormalsOutwards) {
  if (!hasIsoSurfaces()) GTEST_SKIP() << "this build has no VTK";
  const double q = std::pow(0.01 * 1e5 * 0.01, 2);  // where |r| = radius = 0.01
  const IsoSurface surface = isoSurface(ball(0.01f), q, 1000000);
  ASSERT_GT(surface.triangles.size(), 1000u);
  const Eigen::Vector3f centre(0.0f, 0.03f, 0.0f);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Eigen::Vector3f r = surface.points[i] - centre;
    ASSERT_NEAR(r.norm(), 0.01f, 2e-4f);
    ASSERT_GT(r.normalized().dot(surface.normals[i]), 0.9f);
    if (std::abs(r.x()) <= 0.0021f) continue;
    ASSERT_NEAR(surface.omega_y[i], r.x() < 0 ? -5.0f : 5.0f, 1e-3f);
  }
  EXPECT_LE(isoSurface(ball(0.01f), q, 800).triangles.size(), 800u);
  EXPECT_GT(isoSurface(ball(0.01f), q, 800).triangles.size(), 100u);
  EXPECT_NEAR(largestVorticity(ball(0.01f), q), 5.0, 1e-6);
}

TEST(Vortices, AreClosedWhereTheyLeaveTheBlock) {
  if (!hasIsoSurfaces()) GTEST_SKIP() << "this build has no VTK";
  const double q = std::pow(0.01 * 1e5 * 0.035, 2);  // where |r| = 0.025, beyond the block's faces
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles_at;
  for (const auto& t : isoSurface(ball(0.03f), q, 1000000).triangles) {
    for (std::size_t i : {0, 1, 2}) ++triangles_at[std::minmax(t[i], t[(i + 1) % 3])];
  }
  ASSERT_GT(triangles_at.size(), 1000u);
  for (const auto& [edge, triangles] : triangles_at) ASSERT_EQ(2, triangles) << edge.first;
}

TEST(Vortices, OfTheMirroredWingAreTheImage) {
  IsoSurface surface;
  surface.points = {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}};
  surface.normals = {{0, 0, -1}, {0, 0, -1}, {0, 0, 1}};
  surface.omega_y = {10.0f, 0.0f, -10.0f};
  surface.triangles = {{0, 1, 2}};
  VortexLook look;
  look.limit = 10.0;
  const Marker right = vortexMarker(surface, Side::kRight, false, look, {2, 0});
  const Marker left = vortexMarker(surface, Side::kLeft, true, look, {2, 0});
  ASSERT_EQ(3u, left.points.size());
  EXPECT_EQ(2.0, right.points[0].y);
  EXPECT_EQ(-2.0, left.points[0].y);
  EXPECT_GT(left.colors[0].r, left.colors[0].b);  // orange: with the span
  EXPECT_LT(left.colors[2].r, left.colors[2].b);
  EXPECT_EQ(look.opacity, left.colors[0].a);
}

TEST(Slice, LiesAcrossTheSpanAndIsClearWhereNothingTurns) {
  FlowPicture p = ball(0.01f);
  const Marker slice = sliceMarker(p, Side::kRight, false, 0.03, 5.0, {2, 0});
  ASSERT_EQ(40u * 40u * 6u, slice.points.size());
  for (const auto& at : slice.points) ASSERT_NEAR(at.y, 0.03, 1e-9);
  EXPECT_GT(slice.colors[0].a, 0.5f);
  p.omega_y.assign(p.omega_y.size(), 0);
  EXPECT_EQ(0.0f, sliceMarker(p, Side::kRight, false, 0.03, 5.0, {2, 0}).colors[0].a);
  EXPECT_TRUE(sliceMarker(p, Side::kRight, false, 0.3, 5.0, {2, 0}).points.empty());
}

}  // namespace
}  // namespace monarch_flight
