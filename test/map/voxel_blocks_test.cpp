// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/voxel_blocks.hpp"

#include <gtest/gtest.h>

#include <set>

namespace lio {
namespace {

using Blocks = VoxelBlocks<int>;

TEST(VoxelBlocks, AVoxelIsFoundInTheBlockAroundIt) {
  Blocks blocks(0.5, 8);
  const VoxelCell voxel = blocks.VoxelAt({1.1, -0.3, 2.6});
  EXPECT_EQ(voxel, (VoxelCell{2, -1, 5}));
  EXPECT_EQ(blocks.Find(voxel), Blocks::kNone);
  const VoxelIndex::Added added = blocks.FindOrAdd(voxel);
  EXPECT_TRUE(added.is_new);
  EXPECT_EQ(blocks.Find(voxel), added.voxel);
  EXPECT_EQ(blocks.Find({0, -4, 7}), added.voxel);  // the same block of 4 x 4 x 4
  EXPECT_EQ(blocks.Find({4, -1, 5}), Blocks::kNone);
  EXPECT_FALSE(blocks.FindOrAdd({0, -4, 7}).is_new);
  EXPECT_EQ(blocks.block(added.voxel).at, (VoxelCell{0, -1, 1}));
  EXPECT_LT((blocks.CornerOf(blocks.block(added.voxel)) - Vector3(0, -2, 2)).norm(), 1e-12);
}

TEST(VoxelBlocks, EveryVoxelOfABlockHasItsOwnBit) {
  std::set<std::int32_t> bits;
  for (std::int32_t x = -4; x < 0; ++x) {
    for (std::int32_t y = 8; y < 12; ++y) {
      for (std::int32_t z = 0; z < 4; ++z) bits.insert(Blocks::InBlock({x, y, z}));
    }
  }
  EXPECT_EQ(bits.size(), Blocks::kVoxels);
  EXPECT_EQ(*bits.begin(), 0);
  EXPECT_EQ(*bits.rbegin(), 63);
  EXPECT_EQ(Blocks::InBlock({1, 2, 3}), 1 + 4 * 2 + 16 * 3);
}

TEST(VoxelBlocks, BlocksOfARegionAreVisitedByPlace) {
  Blocks blocks(1.0, 8);
  for (const std::int32_t x : {20, 4, 0, -4}) blocks.FindOrAdd({x, 0, 0});
  blocks.FindOrAdd({0, 40, 0});
  std::vector<std::int32_t> visited;
  blocks.ForEachBlock({-1, 0, 0}, {7, 3, 3}, [&](std::int32_t number, const Blocks::Block& block) {
    EXPECT_EQ(&block, &blocks.block(number));
    visited.push_back(block.at[0]);
  });
  EXPECT_EQ(visited, (std::vector<std::int32_t>{-1, 0, 1}));
}

TEST(VoxelBlocks, ARemovedBlockIsEmptyWhenItsNumberIsGivenAgain) {
  Blocks blocks(1.0, 8);
  const std::int32_t first = blocks.FindOrAdd({0, 0, 0}).voxel;
  const std::int32_t second = blocks.FindOrAdd({9, 0, 0}).voxel;
  blocks.block(first).occupied = 5;
  blocks.Touch(first);
  EXPECT_EQ(blocks.oldest(), second);
  blocks.Remove(first);
  EXPECT_FALSE(blocks.IsUsed(first));
  EXPECT_EQ(blocks.Find({0, 0, 0}), Blocks::kNone);
  const VoxelIndex::Added again = blocks.FindOrAdd({0, 80, 0});
  EXPECT_EQ(again.voxel, first);
  EXPECT_EQ(blocks.block(again.voxel).occupied, 0u);
  EXPECT_EQ(blocks.capacity(), 2u);
}

TEST(VoxelBlocks, PlacesAtTheEndOfTheGridAreOutOfRange) {
  const Blocks blocks(1.0, 8);
  EXPECT_TRUE(blocks.IsInRange({1000, -1000, 0}));
  EXPECT_TRUE(blocks.IsInRange({kVoxelCoordinateLimit - 17, 0, 0}));
  EXPECT_FALSE(blocks.IsInRange({kVoxelCoordinateLimit - 16, 0, 0}));
  EXPECT_FALSE(blocks.IsInRange({0, 0, -kVoxelCoordinateLimit}));
}

}  // namespace
}  // namespace lio
