// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/voxel_index.hpp"

#include <gtest/gtest.h>

#include <list>
#include <map>
#include <random>

namespace lio {
namespace {

// The index is compared with std::map and std::list through many random calls.
TEST(VoxelIndex, AgreesWithAPlainModel) {
  VoxelIndex index;
  std::map<VoxelKey, std::int32_t> model;
  std::list<VoxelKey> by_age;  // oldest first
  std::mt19937 random(1);
  for (int step = 0; step < 20000; ++step) {
    const VoxelKey key = PackVoxel(static_cast<int>(random() % 20), static_cast<int>(random() % 20),
                                   static_cast<int>(random() % 3));
    const auto in_model = model.find(key);
    const std::int32_t voxel = index.Find(key);
    ASSERT_EQ(voxel, in_model == model.end() ? VoxelIndex::kNone : in_model->second);
    if (random() % 3 == 0 && voxel != VoxelIndex::kNone) {
      index.Remove(voxel);
      model.erase(key);
      by_age.remove(key);
      ASSERT_FALSE(index.IsUsed(voxel));
    } else {
      const auto added = index.FindOrAdd(key);
      ASSERT_EQ(added.is_new, in_model == model.end());
      if (!added.is_new) {
        index.Touch(added.voxel);
        by_age.remove(key);
      }
      ASSERT_EQ(index.key(added.voxel), key);
      model[key] = added.voxel;
      by_age.push_back(key);
    }
    ASSERT_EQ(index.size(), model.size());
    ASSERT_EQ(index.oldest() == VoxelIndex::kNone, by_age.empty());
    if (!by_age.empty()) {
      ASSERT_EQ(index.key(index.oldest()), by_age.front());
    }
  }
  EXPECT_LE(index.capacity(), 1200u);  // numbers are given again
}

}  // namespace
}  // namespace lio
