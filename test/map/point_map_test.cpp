// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/point_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace lio {
namespace {

std::vector<Vector3> RandomPositions(int count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({uniform(random), uniform(random), uniform(random)});
  }
  return points;
}

// The points are far enough apart that each has a voxel of its own.
PointMapOptions FineOptions() {
  PointMapOptions options;
  options.voxel_m = 0.01;
  return options;
}

// Returns the voxel of a map with these options around a point.
VoxelCell VoxelAround(const Vector3& point, const PointMapOptions& options) {
  return VoxelOf(1.0 / options.voxel_m * point);
}

TEST(PointMap, WiderSearchFindsTheExactNearest) {
  PointMapOptions options = FineOptions();
  options.voxel_m = 0.1;
  options.max_voxel_points = 1;  // a voxel is its first point
  PointMap map(options);
  std::vector<Vector3> kept;
  std::set<VoxelCell> voxels;
  for (const Vector3& point : RandomPositions(500, 2.0, 1)) {
    if (voxels.insert(VoxelAround(point, options)).second) kept.push_back(point);
  }
  map.Insert(kept, Vector3::Zero());
  for (const Vector3& query : RandomPositions(50, 2.0, 2)) {
    std::vector<double> expected;
    for (const Vector3& point : kept) expected.push_back((point - query).norm());
    std::sort(expected.begin(), expected.end());
    const auto found = map.FindNearest(query, 5, 1.15);  // more than the 27 voxels hold
    int num_within = 0;
    while (num_within < 5 && expected[static_cast<std::size_t>(num_within)] < 1.15) ++num_within;
    ASSERT_EQ(found.count, num_within);
    for (int i = 0; i < found.count; ++i) {
      const auto& neighbour = found.list[static_cast<std::size_t>(i)];
      EXPECT_NEAR(std::sqrt(neighbour.distance_sq), expected[static_cast<std::size_t>(i)], 1e-6);
      EXPECT_NEAR(neighbour.from_query.norm(), expected[static_cast<std::size_t>(i)], 1e-6);
    }
  }
}

TEST(PointMap, NothingBeyondTheRadius) {
  PointMap map(PointMapOptions{});
  map.Insert(std::vector<Vector3>{{1, 0, 0}, {3, 0, 0}}, Vector3::Zero());
  EXPECT_EQ(map.FindNearest({0, 0, 0}, 5, 0.9).count, 0);
  EXPECT_EQ(map.FindNearest({0, 0, 0}, 5, 1.1).count, 1);
  EXPECT_EQ(map.FindNearest({0, 0, 0}, 5, 3.1).count, 2);
  EXPECT_EQ(map.FindNearest({0, 0, 0}, 1, 3.1).count, 1);
}

TEST(PointMap, VoxelIsTheMeanOfItsPointsUntilFrozen) {
  PointMapOptions options;
  options.max_voxel_points = 4;
  PointMap map(options);
  const Vector3 centre(1000.2, -2000.2, 0.2);  // far from the origin: precision must not suffer
  for (int i = 0; i < 4; ++i) {
    const Vector3 shift(0.01 * i, 0, 0);
    EXPECT_EQ(map.ContentAt(centre).num_points, i);
    EXPECT_FALSE(map.ContentAt(centre).is_frozen);
    map.Insert(std::vector<Vector3>{centre + shift}, centre);
  }
  EXPECT_TRUE(map.ContentAt(centre).is_frozen);
  map.Insert(std::vector<Vector3>{centre + Vector3(0.1, 0.1, 0.1)}, centre);
  const auto found = map.FindNearest(centre, 1, 1.0);
  ASSERT_EQ(found.count, 1);
  EXPECT_NEAR(found.list[0].from_query.x(), 0.015, 1e-6);
  EXPECT_NEAR(found.list[0].from_query.y(), 0.0, 1e-6);
}

TEST(PointMap, BoundsHoldExactlyAfterEveryInsertion) {
  PointMapOptions options;
  options.max_voxels = 300;
  options.max_distance_m = 30.0;
  PointMap map(options);
  std::vector<Vector3> all;
  for (int scan = 0; scan < 40; ++scan) {
    const Vector3 centre(3.0 * scan, 0, 0);
    std::vector<Vector3> points = RandomPositions(60, 20.0, static_cast<unsigned>(scan));
    for (Vector3& point : points) point += centre;
    map.Insert(points, centre);
    all.insert(all.end(), points.begin(), points.end());
    ASSERT_LE(map.num_voxels(), 300u);
    std::set<VoxelCell> held;
    for (const Vector3& point : all) {
      if (map.ContentAt(point).num_points == 0) continue;
      held.insert(VoxelAround(point, options));
      const double half_block = 0.8 * std::sqrt(3.0);
      ASSERT_LE((point - centre).norm(), 30.0 + half_block + 0.4);
    }
    ASSERT_EQ(held.size(), map.num_voxels());  // the count is true
  }
}

TEST(PointMap, OldestBlocksGoFirst) {
  PointMapOptions options;
  options.max_voxels = 3;
  PointMap map(options);
  const auto add = [&](double x) { map.Insert(std::vector<Vector3>{{x, 0, 0}}, Vector3::Zero()); };
  add(0);
  add(10);
  add(20);
  add(0);   // touched again
  add(30);  // one too many
  EXPECT_EQ(map.ContentAt({0, 0, 0}).num_points, 2);
  EXPECT_EQ(map.ContentAt({10, 0, 0}).num_points, 0);
  EXPECT_EQ(map.ContentAt({20, 0, 0}).num_points, 1);
  EXPECT_EQ(map.num_voxels(), 3u);
}

TEST(PointMap, OptionsOutOfRangeAreRefused) {
  PointMapOptions options;
  options.voxel_m = 0;
  EXPECT_THROW(PointMap{options}, std::invalid_argument);
}

TEST(PointMap, PointsOutsideTheRangeOfKeysAreLeftOut) {
  PointMap map(PointMapOptions{});
  const Vector3 far(1e9, 0, 0);
  map.Insert(std::vector<Vector3>{far}, far);
  EXPECT_EQ(map.num_voxels(), 0u);
  EXPECT_EQ(map.FindNearest(far, 1, 1.0).count, 0);
}

}  // namespace
}  // namespace lio
