// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/full_cloud.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lio {
namespace {

FullCloudTask StandingTask(std::size_t num_points) {
  auto sweep = std::make_shared<Sweep>();
  sweep->start = Timestamp{1'000'000'000};
  sweep->end = Timestamp{1'100'000'000};
  sweep->scan_seq = 8;
  for (std::size_t i = 0; i < num_points; ++i) {
    sweep->points.push_back({1.0F, 2.0F, 3.0F, static_cast<std::uint32_t>(i), 77, 5});
  }
  FullCloudTask task;
  task.T_any_imu = {{sweep->start, Pose::Identity()}, {sweep->end, Pose::Identity()}};
  task.T_imu_lidar.translation = Vector3(0, 0, 0.5);
  task.T_map_imu.translation = Vector3(100, 0, 0);
  task.sweep = sweep;
  return task;
}

TEST(FullCloud, PointsStandInTheMapAndKeepTheirInstantIntensityAndRing) {
  const auto chunks = RegisterFullCloud(StandingTask(3));
  ASSERT_EQ(chunks.size(), 1u);
  EXPECT_EQ(chunks[0].sensor_id, -1);
  EXPECT_EQ(chunks[0].scan_seq, 8);
  EXPECT_EQ(chunks[0].stamp, Timestamp{1'000'000'000});
  ASSERT_EQ(chunks[0].points.size(), 3u);
  const LidarPoint& point = chunks[0].points[2];
  EXPECT_FLOAT_EQ(point.x_m, 101.0F);
  EXPECT_FLOAT_EQ(point.y_m, 2.0F);
  EXPECT_FLOAT_EQ(point.z_m, 3.5F);
  EXPECT_EQ(point.t_offset_ns, 2u);
  EXPECT_EQ(point.intensity, 77);
  EXPECT_EQ(point.ring, 5);
}

TEST(FullCloud, LargeSweepsAreSplitIntoNumberedChunks) {
  const auto chunks = RegisterFullCloud(StandingTask(2 * kMaxChunkPoints + 1));
  ASSERT_EQ(chunks.size(), 3u);
  std::size_t num_points = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    EXPECT_EQ(chunks[i].chunk_index, static_cast<int>(i));
    EXPECT_EQ(chunks[i].chunk_count, 3);
    EXPECT_LE(chunks[i].points.size(), static_cast<std::size_t>(kMaxChunkPoints));
    num_points += chunks[i].points.size();
  }
  EXPECT_EQ(num_points, 2u * kMaxChunkPoints + 1);
}

TEST(FullCloud, PointsThatAreNotFiniteAreLeftOut) {
  FullCloudTask task = StandingTask(4);
  auto sweep = std::make_shared<Sweep>(*task.sweep);
  sweep->points[1].y_m = std::numeric_limits<float>::quiet_NaN();
  task.sweep = sweep;
  EXPECT_EQ(RegisterFullCloud(task)[0].points.size(), 3u);
}

TEST(FullCloud, AnEmptySweepGivesNothing) {
  EXPECT_TRUE(RegisterFullCloud(StandingTask(0)).empty());
}

}  // namespace
}  // namespace lio
