// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/map_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace lio {
namespace {

TEST(MapCloud, KeepsOnePointAVoxelInTheMapsFrame) {
  MapCloud cloud;
  const std::vector<Eigen::Vector3f> points = {{1.01F, 0, 0}, {1.02F, 0, 0}, {2.5F, 0, 0}};
  const Pose turned{ExpSo3(Vector3(0, 0, std::acos(-1.0) / 2)), Vector3(0.05, 10, 0.05)};
  cloud.Add(points, turned);
  cloud.Add(points, turned);
  ASSERT_EQ(cloud.points_map().size(), 2u);
  EXPECT_NEAR(cloud.points_map()[0].y(), 11.01, 1e-5);
  EXPECT_NEAR(cloud.points_map()[1].y(), 12.5, 1e-5);
}

TEST(MapCloud, PointsThatCannotBePlacedAreLeftOut) {
  MapCloud cloud;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Eigen::Vector3f> points = {{nan, 0, 0}, {1e9F, 0, 0}, {1, 1, 1}};
  cloud.Add(points, Pose::Identity());
  EXPECT_EQ(cloud.points_map().size(), 1u);
}

TEST(MapCloud, ClearForgetsEverything) {
  MapCloud cloud;
  const std::vector<Eigen::Vector3f> points = {{1, 1, 1}};
  cloud.Add(points, Pose::Identity());
  cloud.Clear();
  cloud.Add(points, Pose::Identity());
  EXPECT_EQ(cloud.points_map().size(), 1u);
}

TEST(MapCloud, ManyPointsAreThinnedAndStayBounded) {
  constexpr std::size_t kMax = 1000;
  MapCloud cloud(kMax);
  std::vector<Eigen::Vector3f> floor;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j)
      floor.push_back(Eigen::Vector3i(i, j, 0).cast<float>() * 0.2F +
                      Eigen::Vector3f::Constant(0.1F));
  }
  cloud.Add(floor, Pose::Identity());
  EXPECT_LE(cloud.points_map().size(), kMax);
  EXPECT_GT(cloud.points_map().size(), kMax / 5);
  EXPECT_EQ(cloud.voxel_m(), 0.8);
  EXPECT_NE(cloud.thinned().find("one for each 0.8 m"), std::string::npos);
  float farthest = 0.0F;
  for (const Eigen::Vector3f& point : cloud.points_map()) farthest = std::max(farthest, point.x());
  EXPECT_GT(farthest, 19.0F) << "what came last is there, too";
  cloud.Clear();
  EXPECT_EQ(cloud.voxel_m(), MapCloud::kVoxel_m);
}

}  // namespace
}  // namespace lio
