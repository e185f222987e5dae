// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/feature_clouds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lio {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Point i is at x = i and belongs to ring 0.
FeatureCloudTask Task(std::size_t num_points, LoamFeatures features) {
  auto sweep = std::make_shared<Sweep>();
  sweep->scan_seq = 7;
  sweep->start = Timestamp{5};
  for (std::size_t i = 0; i < num_points; ++i) {
    LidarPoint point;
    point.x_m = static_cast<float>(i);
    sweep->points.push_back(point);
  }
  return {sweep, std::make_shared<LoamFeatures>(std::move(features))};
}

std::vector<float> PlacesOf(const FeatureCloudTask& task, FeatureSet set) {
  std::vector<float> places;
  for (const ScanChunk& chunk : FeatureCloud(task, set)) {
    for (const LidarPoint& point : chunk.points) places.push_back(point.x_m);
  }
  return places;
}

TEST(FeatureClouds, EachSetHasItsPoints) {
  LoamFeatures features;
  features.sharp = {1};
  features.less_sharp = {1, 2};
  features.flat = {3};
  features.less_flat = {4, 5};
  features.occluded = {8, 6};
  features.grazed = {7, 8};
  const FeatureCloudTask task = Task(10, features);
  EXPECT_THAT(PlacesOf(task, FeatureSet::kCornerSharp), ElementsAre(1));
  EXPECT_THAT(PlacesOf(task, FeatureSet::kCornerLessSharp), ElementsAre(1, 2));
  EXPECT_THAT(PlacesOf(task, FeatureSet::kSurfFlat), ElementsAre(3));
  EXPECT_THAT(PlacesOf(task, FeatureSet::kSurfLessFlat), ElementsAre(4, 5));
  EXPECT_THAT(PlacesOf(task, FeatureSet::kRemoved), ElementsAre(6, 7, 8));
}

TEST(FeatureClouds, ChunksFitIntoOneDatagramAndNameTheirScan) {
  LoamFeatures features;
  for (std::uint32_t i = 0; i < 2 * kMaxChunkPoints + 1; ++i) features.less_flat.push_back(i);
  const auto chunks =
      FeatureCloud(Task(features.less_flat.size(), features), FeatureSet::kSurfLessFlat);
  ASSERT_EQ(chunks.size(), 3u);
  EXPECT_EQ(chunks[0].points.size(), static_cast<std::size_t>(kMaxChunkPoints));
  EXPECT_EQ(chunks[2].points.size(), 1u);
  EXPECT_EQ(chunks[2].chunk_index, 2);
  EXPECT_EQ(chunks[2].chunk_count, 3);
  EXPECT_EQ(chunks[2].scan_seq, 7);
  EXPECT_EQ(chunks[2].stamp.ns, 5);
}

TEST(FeatureClouds, RebuiltRingsAreTold) {
  LoamFeatures features;
  features.flat = {1};
  features.rebuilt_rings = {0, 9};
  const auto chunks = FeatureCloud(Task(2, features), FeatureSet::kSurfFlat);
  ASSERT_EQ(chunks.size(), 1u);
  EXPECT_EQ(chunks[0].points[0].ring, 9);
}

TEST(FeatureClouds, EmptySetGivesNoMessage) {
  EXPECT_THAT(FeatureCloud(Task(2, {}), FeatureSet::kRemoved), IsEmpty());
}

}  // namespace
}  // namespace lio
