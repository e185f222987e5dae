// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lio/map/gaussian_map.hpp"
#include "lio/map/map_parameters.hpp"
#include "support/gaussian_cells.hpp"

namespace lio {
namespace {

const Vector3 kLidarAt(0.5, 0.5, 0.5);
const Vector3 kThing = CentreOf(5, 0, 0);  // between the sensor and the wall

// Returns points of a wall that faces the sensor, 10 m ahead and 1 m wide.
std::vector<Vector3> Wall(unsigned seed) {
  return PlanePoints(CentreOf(10, 0, 0), {-1, 0, 0}, 500, seed);
}

void SeeWall(GaussianMap& map, int num_scans) {
  for (int i = 0; i < num_scans; ++i) map.Insert(Wall(static_cast<unsigned>(i + 10)), kLidarAt);
}

// Returns a scan of which one ray is followed.
std::vector<Vector3> OneRay(const Vector3& to) {
  return std::vector<Vector3>(GaussianMapParameters::kRaySampling, to);
}

GaussianMap MapWith(const std::vector<Vector3>& thing) {
  GaussianMap map(TestOptions());
  map.Insert(thing, kLidarAt);
  return map;
}

bool ShowsSurface(const GaussianMap& map, const Vector3& at) {
  return Has(map, at) && PatchAt(map, at).thickness_var > 0.f;
}

std::vector<Vector3> Post() {
  std::vector<Vector3> points;
  for (int i = 0; i < 40; ++i) {
    const double turn = 0.7 * i;
    points.push_back(kThing +
                     Vector3(0.15 * std::cos(turn), 0.15 * std::sin(turn), -0.45 + 0.0225 * i));
  }
  return points;
}

TEST(GaussianMapRays, WhatHasGoneIsForgottenAndTheWallBehindItIsNot) {
  GaussianMap map = MapWith(PlanePoints(kThing, {-1, 0, 0}, 50));
  ASSERT_TRUE(ShowsSurface(map, kThing));
  SeeWall(map, 30);
  EXPECT_FALSE(Has(map, kThing));
  EXPECT_TRUE(ShowsSurface(map, CentreOf(10, 0, 0)));
}

TEST(GaussianMapRays, APersonWhoHasGoneIsForgotten) {
  GaussianMap map = MapWith(Post());
  ASSERT_TRUE(ShowsSurface(map, kThing));
  ASSERT_EQ(PatchAt(map, kThing).kind, SurfacePatch::Kind::kVertical);
  SeeWall(map, 40);
  EXPECT_FALSE(Has(map, kThing));
}

TEST(GaussianMapRays, WhatSomeRaysOfAScanHitStays) {
  GaussianMap map = MapWith(PlanePoints(kThing, {-1, 0, 0}, 50));
  for (unsigned i = 0; i < 40; ++i) {
    std::vector<Vector3> fence = Wall(i);
    fence.push_back(kThing);
    map.Insert(fence, kLidarAt);
  }
  EXPECT_TRUE(ShowsSurface(map, kThing));
}

TEST(GaussianMapRays, WhatIsBehindTheWallOrBesideTheRaysStays) {
  const Vector3 behind = CentreOf(12, 0, 0), beside = CentreOf(5, 2, 0);
  std::vector<Vector3> things = PlanePoints(behind, {-1, 0, 0}, 50);
  for (const Vector3& point : PlanePoints(beside, {-1, 0, 0}, 50)) things.push_back(point);
  GaussianMap map = MapWith(things);
  SeeWall(map, 40);
  EXPECT_TRUE(ShowsSurface(map, behind));
  EXPECT_TRUE(ShowsSurface(map, beside));
}

TEST(GaussianMapRays, RaysBesideAThingInItsOwnVoxelDoNotPassThroughIt) {
  std::vector<Vector3> half = PlanePoints(kThing, {-1, 0, 0}, 100);
  for (Vector3& point : half) point.y() = 0.5 * point.y() + 0.5;  // from 0.525 to 0.975
  GaussianMap map = MapWith(half);
  ASSERT_TRUE(ShowsSurface(map, kThing));
  for (int i = 0; i < 5; ++i) map.Insert(OneRay({10.5, 0.4, 0.5}), kLidarAt);
  EXPECT_TRUE(ShowsSurface(map, kThing));
  for (int i = 0; i < 5; ++i) map.Insert(OneRay({10.5, 1.0, 0.5}), kLidarAt);
  EXPECT_FALSE(Has(map, kThing));
}

// Noise of ranges and mixed pixels lie there.
TEST(GaussianMapRays, WhatIsNearerToTheHitThanAVoxelStays) {
  const Vector3 near(9.8, 0.5, 0.5);
  GaussianMap map = MapWith(PlanePoints(near, {-1, 0, 0}, 200));
  ASSERT_TRUE(ShowsSurface(map, near));
  for (int i = 0; i < 5; ++i) map.Insert(OneRay({10.6, 0.5, 0.5}), kLidarAt);
  EXPECT_TRUE(ShowsSurface(map, near));
  for (int i = 0; i < 5; ++i) map.Insert(OneRay({11.6, 0.5, 0.5}), kLidarAt);
  EXPECT_FALSE(Has(map, near));
}

// The rays come down through the floor's voxel by less than 6 deg.
TEST(GaussianMapRays, RaysAlongASurfaceDoNotPassThroughIt) {
  GaussianMap map(TestOptions());
  map.Insert(PlanePoints(kThing, {0, 0, 1}, 50), kThing + Vector3(0, 0, 5));
  ASSERT_TRUE(ShowsSurface(map, kThing));
  for (unsigned i = 0; i < 40; ++i) map.Insert(Wall(i), kLidarAt + Vector3(0, 0, 0.4));
  EXPECT_TRUE(ShowsSurface(map, kThing));
}

TEST(GaussianMapRays, OneRayIsNotEnough) {
  GaussianMap map = MapWith(PlanePoints(kThing, {-1, 0, 0}, 50));
  map.Insert(OneRay(CentreOf(10, 0, 0)), kLidarAt);
  EXPECT_TRUE(Has(map, kThing));
  map.Insert({{kThing}}, kLidarAt);  // it is there again, and one ray more passes
  map.Insert(OneRay(CentreOf(10, 0, 0)), kLidarAt);
  EXPECT_TRUE(Has(map, kThing));
  map.Insert(OneRay(CentreOf(10, 0, 0)), kLidarAt);
  EXPECT_FALSE(Has(map, kThing));
}

TEST(GaussianMapRays, ASavedMapStays) {
  GaussianMap map(TestOptions());
  const std::vector<Vector3> points = PlanePoints(kThing, {-1, 0, 0}, 50);
  const std::vector<Eigen::Vector3f> sides(points.size(), {-1, 0, 0});
  map.InsertKept(points, sides);
  SeeWall(map, 40);
  EXPECT_TRUE(ShowsSurface(map, kThing));
}

TEST(GaussianMapRays, PointsAtTheSensorOrFarAwayAreNoRays) {
  GaussianMap map(TestOptions());
  map.Insert(std::vector<Vector3>(200, kLidarAt), kLidarAt);
  map.Insert(std::vector<Vector3>(200, Vector3(1e9, 0, 0)), kLidarAt);
  map.Insert(std::vector<Vector3>(200, Vector3::Constant(std::nan(""))), kLidarAt);
  EXPECT_TRUE(Has(map, kLidarAt));
}

}  // namespace
}  // namespace lio
