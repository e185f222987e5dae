// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/map_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

// Returns points of a room's floor, 2 cm apart.
std::vector<Eigen::Vector3f> Floor(float edge_m) {
  std::vector<Eigen::Vector3f> points;
  const int num = static_cast<int>(edge_m / 0.02F);
  for (int i = 0; i < num; ++i) {
    for (int j = 0; j < num; ++j) {
      points.push_back(Eigen::Vector3i(i, j, 0).cast<float>() * 0.02F +
                       Eigen::Vector3f::Constant(0.01F));
    }
  }
  return points;
}

double PointsPerSquareMetre(const MapCloud& cloud, float edge_m) {
  return static_cast<double>(cloud.points_map().size()) / (edge_m * edge_m);
}

TEST(MapCloud, VoxelsAreSmallInNarrowPlaces) {
  MapCloud room;
  room.Add(Floor(4.0F), Pose::Identity());
  EXPECT_NEAR(PointsPerSquareMetre(room, 4.0F), std::pow(MapCloud::kNarrowVoxel_m, -2), 20.0);
  MapCloud hall;
  hall.Add(Floor(20.0F), Pose::Identity());
  EXPECT_NEAR(PointsPerSquareMetre(hall, 20.0F), std::pow(MapCloud::kVoxel_m, -2), 2.0);
}

TEST(MapCloud, SavedMapKeepsItsPointsAndHallsAddNoneBesideThem) {
  MapCloud room;
  room.Add(Floor(4.0F), Pose::Identity());
  MapCloud extended;
  extended.AddSaved(room.points_map());
  EXPECT_EQ(extended.points_map(), room.points_map());
  extended.Add(Floor(20.0F), Pose::Identity());
  const double of_hall = std::pow(MapCloud::kVoxel_m, -2) * (20.0 * 20.0 - 4.0 * 4.0);
  EXPECT_NEAR(static_cast<double>(extended.points_map().size() - room.points_map().size()), of_hall,
              0.05 * of_hall);
}

TEST(MapCloud, DensePointsAreThinnedAndStayBounded) {
  constexpr std::size_t kMax = 3000;
  MapCloud room(kMax);
  room.Add(Floor(4.0F), Pose::Identity());
  EXPECT_LE(room.points_map().size(), kMax);
  EXPECT_GT(room.points_map().size(), kMax / 5);
  EXPECT_EQ(room.voxel_m(), 2.0 * MapCloud::kVoxel_m);
}

}  // namespace
}  // namespace lio
