// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/height_votes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace lio {
namespace {

using Points = std::vector<Eigen::Vector3f>;

// Adds a floor of 12 m by 12 m.
void AddFloor(float height_m, Points& points) {
  for (int x = 0; x < 60; ++x) {
    for (int y = 0; y < 60; ++y) {
      points.emplace_back(0.2f * static_cast<float>(x), 0.2f * static_cast<float>(y), height_m);
    }
  }
}

TEST(HeightVotes, FloorsTellTheHeight) {
  Points map;
  AddFloor(7.1f, map);
  Points cloud;
  AddFloor(-1.6f, cloud);
  const auto heights = HeightVotes(map).Find(cloud, PlanarPose{});
  ASSERT_FALSE(heights.empty());
  EXPECT_NEAR(heights.front(), 8.7f, 0.3f);
}

TEST(HeightVotes, EachStoreyIsAPlace) {
  Points map;
  for (const float height_m : {0.f, 3.3f, 6.6f}) AddFloor(height_m, map);
  Points cloud;
  AddFloor(-1.6f, cloud);
  auto heights = HeightVotes(map).Find(cloud, PlanarPose{{0.f, 0.f}, 0.f});
  ASSERT_EQ(heights.size(), 3u);
  std::sort(heights.begin(), heights.end());
  EXPECT_NEAR(heights[0], 1.6f, 0.3f);
  EXPECT_NEAR(heights[1], 4.9f, 0.3f);
  EXPECT_NEAR(heights[2], 8.2f, 0.3f);
}

TEST(HeightVotes, ThePlaceSeenFromAboveIsApplied) {
  Points map;
  AddFloor(2.f, map);
  Points cloud{{1.f, 0.f, 0.f}, {2.f, 0.f, 0.f}};
  EXPECT_TRUE(HeightVotes(map).Find(cloud, PlanarPose{{-100.f, 0.f}, 0.f}).empty());
  EXPECT_FALSE(HeightVotes(map).Find(cloud, PlanarPose{{5.f, 3.f}, 1.57f}).empty());
}

TEST(HeightVotes, NothingVotesWithoutPoints) {
  Points cloud;
  AddFloor(0.f, cloud);
  EXPECT_TRUE(HeightVotes({}).Find(cloud, PlanarPose{}).empty());
  EXPECT_TRUE(HeightVotes(cloud).Find({}, PlanarPose{}).empty());
}

}  // namespace
}  // namespace lio
