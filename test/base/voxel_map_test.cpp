// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/voxel_map.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lio {
namespace {

struct Count {
  int value = 7;
};
using Map = VoxelMap<Count, std::string>;

const VoxelKey kHere = PackVoxel(1, -2, 3);
const VoxelKey kThere = PackVoxel(1, -2, 4);

TEST(VoxelMap, NewVoxelHoldsTheDefaultOfEachContent) {
  Map map;
  const auto added = map.FindOrAdd(kHere);
  EXPECT_TRUE(added.is_new);
  EXPECT_EQ(map.Of<Count>(added.voxel).value, 7);
  EXPECT_EQ(map.Of<std::string>(added.voxel), "");
}

TEST(VoxelMap, FoundVoxelKeepsItsContents) {
  Map map;
  const std::int32_t here = map.FindOrAdd(kHere).voxel;
  map.Of<Count>(here).value = 1;
  map.Of<std::string>(here) = "here";
  const std::int32_t there = map.FindOrAdd(kThere).voxel;
  map.Of<Count>(there).value = 2;
  const auto again = map.FindOrAdd(kHere);
  EXPECT_FALSE(again.is_new);
  EXPECT_EQ(again.voxel, here);
  EXPECT_EQ(map.Find(kHere), here);
  EXPECT_EQ(map.Of<Count>(here).value, 1);
  EXPECT_EQ(map.Of<std::string>(here), "here");
  EXPECT_EQ(map.Of<Count>(there).value, 2);
}

TEST(VoxelMap, NumberThatIsGivenAgainHoldsNothingOfTheRemovedVoxel) {
  Map map;
  const std::int32_t here = map.FindOrAdd(kHere).voxel;
  map.Of<Count>(here).value = 1;
  map.Of<std::string>(here) = "here";
  map.Remove(here);
  const std::int32_t there = map.FindOrAdd(kThere).voxel;
  ASSERT_EQ(there, here);
  EXPECT_EQ(map.Of<Count>(there).value, 7);
  EXPECT_EQ(map.Of<std::string>(there), "");
}

TEST(VoxelMap, ClearedMapBeginsAnew) {
  Map map;
  map.Of<Count>(map.FindOrAdd(kHere).voxel).value = 1;
  map.Clear();
  EXPECT_EQ(map.size(), 0u);
  EXPECT_EQ(map.Find(kHere), Map::kNone);
  EXPECT_EQ(map.Of<Count>(map.FindOrAdd(kHere).voxel).value, 7);
}

TEST(VoxelMap, MemoryContainsEveryContent) {
  Map map;
  const std::size_t empty = map.memory_bytes();
  for (int x = 0; x < 100; ++x) map.FindOrAdd(PackVoxel(x, 0, 0));
  EXPECT_EQ(map.capacity(), 100u);
  EXPECT_GE(map.memory_bytes(), empty + 100 * (sizeof(Count) + sizeof(std::string)));
}

}  // namespace
}  // namespace lio
