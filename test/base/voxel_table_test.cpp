// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/voxel_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace lio {
namespace {

struct Counted {
  int count = -1;
};

// It is compared with std::map, through many random calls, with runs of keys that collide.
TEST(VoxelTable, AgreesWithAPlainMapWhileItGrowsAndShrinks) {
  VoxelTable<Counted> table(4);
  std::map<VoxelKey, int> model;
  std::mt19937 random(1);
  for (int step = 0; step < 50'000; ++step) {
    const VoxelKey key = PackVoxel(static_cast<int>(random() % 20), static_cast<int>(random() % 20),
                                   static_cast<int>(random() % 3));
    const auto in_model = model.find(key);
    ASSERT_EQ(table.Find(key).count, in_model == model.end() ? -1 : in_model->second);
    if (random() % 3 == 0 && in_model != model.end()) {
      table.Erase(key);
      model.erase(in_model);
    } else {
      const auto [value, is_new] = table.FindOrAdd(key);
      ASSERT_EQ(is_new, in_model == model.end());
      if (is_new) {
        ASSERT_EQ(value.count, -1);
      }
      value.count = model[key] = step;
    }
    ASSERT_EQ(table.size(), model.size());
  }
  for (const auto& [key, value] : model) EXPECT_EQ(table.Find(key).count, value);
}

TEST(VoxelTable, EveryValueIsVisitedOnce) {
  VoxelTable<Counted> table;
  for (int i = 0; i < 3000; ++i) table.FindOrAdd(PackVoxel(i, -i, 7)).value.count = i;
  std::map<int, int> visits;
  table.ForEachInAnyOrder([&](const Counted& value) { ++visits[value.count]; });
  ASSERT_EQ(visits.size(), 3000u);
  for (const auto& [value, count] : visits) EXPECT_EQ(count, 1) << value;
}

TEST(VoxelTable, ClearLeavesNothingAndKeepsItsMemory) {
  VoxelTable<Counted> table;
  for (int i = 0; i < 3000; ++i) table.FindOrAdd(PackVoxel(i, 0, 0)).value.count = i;
  const std::size_t memory = table.memory_bytes();
  table.Clear();
  EXPECT_EQ(table.size(), 0u);
  EXPECT_EQ(table.memory_bytes(), memory);
  for (int i = 0; i < 3000; ++i) ASSERT_EQ(table.Find(PackVoxel(i, 0, 0)).count, -1);
}

TEST(VoxelTable, NoVoxelIsNeverThere) {
  VoxelTable<Counted> table;
  EXPECT_EQ(table.Find(kNoVoxel).count, -1);
  table.FindOrAdd(0).value.count = 1;  // zero is a key like another
  EXPECT_EQ(table.Find(0).count, 1);
  EXPECT_EQ(table.Find(kNoVoxel).count, -1);
}

}  // namespace
}  // namespace lio
