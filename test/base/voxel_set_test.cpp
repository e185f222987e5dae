// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/voxel_set.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace lio {
namespace {

TEST(VoxelSet, TakesAKeyOnce) {
  VoxelSet set;
  EXPECT_TRUE(set.Insert(PackVoxel(1, 2, 3)));
  EXPECT_FALSE(set.Insert(PackVoxel(1, 2, 3)));
  EXPECT_TRUE(set.Insert(PackVoxel(3, 2, 1)));
  EXPECT_EQ(set.size(), 2u);
}

TEST(VoxelSet, ZeroIsAKeyLikeAnother) {
  VoxelSet set;
  EXPECT_TRUE(set.Insert(0));
  EXPECT_FALSE(set.Insert(0));
}

TEST(VoxelSet, AgreesWithAPlainSetWhileItGrows) {
  VoxelSet set;
  std::set<VoxelKey> model;
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto coordinate = [&] { return static_cast<std::int32_t>(random() % 30) - 15; };
    const VoxelKey key = PackVoxel(coordinate(), coordinate(), coordinate());
    ASSERT_EQ(set.Insert(key), model.insert(key).second) << i;
    ASSERT_EQ(set.size(), model.size());
  }
  EXPECT_GT(set.size(), 8000u);
}

TEST(VoxelSet, IsEmptyAfterEveryClear) {
  VoxelSet set;
  for (int round = 0; round < 300; ++round) {
    for (std::int32_t i = 0; i < 50; ++i) ASSERT_TRUE(set.Insert(PackVoxel(i, round, 0)));
    set.Clear();
    ASSERT_EQ(set.size(), 0u);
    ASSERT_TRUE(set.Insert(PackVoxel(0, round, 0))) << round;
    set.Clear();
  }
}

}  // namespace
}  // namespace lio
