// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/keyframe_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace lio {
namespace {

PointWithNormal PointAt(const Vector3& position) {
  PointWithNormal point;
  point.position = position.cast<float>();
  point.normal = Eigen::Vector3f::UnitX();
  point.thickness_var = 1e-3f;
  return point;
}

std::vector<PointWithNormal> RandomPoints(int count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<PointWithNormal> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(PointAt({uniform(random), uniform(random), uniform(random)}));
  }
  return points;
}

Pose At(double x, double y = 0.0, double z = 0.0) {
  return {Quaternion::Identity(), Vector3(x, y, z)};
}

TEST(KeyframeMap, FindsTheExactNearestOfTheSubmap) {
  KeyframeMapOptions options;
  options.num_near = 2;
  options.num_hull = 0;
  KeyframeMap map(options);
  std::vector<Vector3> in_submap;
  for (int k = 0; k < 4; ++k) {
    const Pose pose{ExpSo3(Vector3(0, 0, 0.5 * k)), Vector3(2000.0 + 2.0 * k, -3000.0, 0)};
    const auto points = RandomPoints(300, 4.0, static_cast<unsigned>(k));
    map.Add(points, pose);
    if (k == 1 || k == 2) {
      for (const PointWithNormal& p : points) in_submap.push_back(pose * p.position.cast<double>());
    }
  }
  const Vector3 place(2003.0, -3000.0, 0);  // between the second and the third
  map.ChooseSubmap(place);
  for (const PointWithNormal& query_point : RandomPoints(200, 5.0, 77)) {
    const Vector3 query = place + query_point.position.cast<double>();
    double expected = std::numeric_limits<double>::infinity();
    for (const Vector3& p : in_submap) expected = std::min(expected, (p - query).norm());
    const KeyframeMap::Hit hit = map.FindNearest(query, 1.7);
    ASSERT_EQ(hit.point >= 0, expected < 1.7);
    if (hit.point < 0) continue;
    EXPECT_NEAR(hit.from_query.norm(), expected, 1e-5);
  }
}

TEST(KeyframeMap, NormalsAreTurnedIntoTheMap) {
  KeyframeMap map(KeyframeMapOptions{});
  const Pose pose{ExpSo3(Vector3(0, 0, 1.5707963267948966)), Vector3(5, 0, 0)};
  map.Add(std::vector{PointAt({1, 0, 0})}, pose);
  map.ChooseSubmap({5, 0, 0});
  const KeyframeMap::Hit hit = map.FindNearest({5, 1.1, 0}, 0.5);
  ASSERT_GE(hit.point, 0);
  EXPECT_NEAR((map.point(hit.point).normal - Eigen::Vector3f::UnitY()).norm(), 0.f, 1e-6f);
  EXPECT_NEAR(hit.from_query.y(), -0.1f, 1e-5f);
}

TEST(KeyframeMap, PointsWithoutANormalAreLeftOut) {
  KeyframeMap map(KeyframeMapOptions{});
  PointWithNormal shapeless;
  shapeless.position = {1, 0, 0};
  map.Add(std::vector{shapeless, PointAt({0, 1, 0})}, At(0));
  EXPECT_EQ(map.num_points(), 1u);
}

TEST(KeyframeMap, SubmapIsTheNearestAndTheHullAndNoOtherStorey) {
  KeyframeMapOptions options;
  options.num_near = 3;
  options.num_hull = 4;
  options.max_distance_m = 1000;
  KeyframeMap map(options);
  // Makes a square of 5 x 5 keyframes of one point, 10 m apart, with numbers 0..24 row by row, and
  // one a storey up. A point is found where its keyframe was chosen.
  std::vector<Pose> poses;
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      poses.push_back(At(10.0 * x, 10.0 * y));
    }
  }
  poses.push_back(At(21, 21, 3.5));
  for (const Pose& pose : poses) map.Add(std::vector{PointAt({0, 0, 0})}, pose);
  map.ChooseSubmap({21, 20, 0});
  const auto chosen = [&](std::size_t i) {
    return map.FindNearest(poses[i].translation, 0.1).point >= 0;
  };
  EXPECT_TRUE(chosen(12));                                          // right here
  EXPECT_TRUE(chosen(13));                                          // beside
  EXPECT_TRUE(chosen(0) && chosen(4) && chosen(20) && chosen(24));  // the corners
  EXPECT_FALSE(chosen(2));                                          // on the hull's side, straight
  EXPECT_FALSE(chosen(25) && chosen(17) && chosen(7));
  int count = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) count += chosen(i);
  EXPECT_EQ(count, 7);
}

TEST(KeyframeMap, FarKeyframesGoAtOnceAndWithAllTheirPoints) {
  KeyframeMapOptions options;
  options.max_distance_m = 25.0;
  KeyframeMap map(options);
  for (int k = 0; k < 10; ++k) {
    map.Add(RandomPoints(100, 5.0, static_cast<unsigned>(k)), At(10.0 * k));
    EXPECT_LE(map.num_keyframes(), 3u);
    EXPECT_EQ(map.num_points(), 100 * map.num_keyframes());
  }
  map.ChooseSubmap({0, 0, 0});
  EXPECT_LT(map.FindNearest({0, 0, 0}, 4.0).point, 0);  // nothing is left there
  EXPECT_GE(map.FindNearest({90, 0, 0}, 4.0).point, 0);
}

TEST(KeyframeMap, BeyondTheBoundTheLongestUnusedGo) {
  KeyframeMapOptions options;
  options.max_points = 350;
  options.num_near = 1;
  options.num_hull = 0;
  options.max_distance_m = 1000;
  KeyframeMap map(options);
  for (int k = 0; k < 3; ++k) map.Add(RandomPoints(100, 2.0, 1), At(10.0 * k));
  map.ChooseSubmap({0, 0, 0});  // the first is in use
  map.ChooseSubmap({20, 0, 0});
  map.Add(RandomPoints(100, 2.0, 1), At(30));
  EXPECT_EQ(map.num_points(), 300u);
  map.ChooseSubmap({10, 0, 0});
  EXPECT_LT(map.FindNearest({10, 0, 0}, 2.0).point, 0);  // the second was used by no one
  map.ChooseSubmap({0, 0, 0});
  EXPECT_GE(map.FindNearest({0, 0, 0}, 2.0).point, 0);
}

TEST(KeyframeMap, CountsArePerVoxelAndSurviveRemoval) {
  KeyframeMapOptions options;
  options.max_distance_m = 5.0;
  KeyframeMap map(options);
  const std::vector<PointWithNormal> points(20, PointAt({0.2, 0.2, 0.2}));
  map.Add(points, At(0));
  map.Add(points, At(0));
  EXPECT_EQ(map.CountAt({0.3, 0.3, 0.3}), 40);
  EXPECT_EQ(map.CountAt({0.7, 0.3, 0.3}), 0);
  map.Add(points, At(6));
  EXPECT_EQ(map.CountAt({0.3, 0.3, 0.3}), 0);
  EXPECT_EQ(map.CountAt({6.3, 0.3, 0.3}), 20);
  EXPECT_EQ(map.NearestKeyframe({0, 0, 0}).T_map_kf.translation.x(), 6.0);
}

TEST(KeyframeMap, NothingIsFoundInAnEmptyOrUnchosenMap) {
  KeyframeMap map(KeyframeMapOptions{});
  map.ChooseSubmap({0, 0, 0});
  EXPECT_LT(map.FindNearest({0, 0, 0}, 2.0).point, 0);
  EXPECT_LT(map.NearestKeyframe({0, 0, 0}).keyframe, 0);
  EXPECT_LT(map.FindNearest({1e12, 0, 0}, 2.0).point, 0);
  KeyframeMapOptions bad;
  bad.voxel_m = 0;
  EXPECT_THROW(KeyframeMap{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace lio
