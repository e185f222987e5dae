// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/voxel_key.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <unordered_set>
#include <vector>

namespace lio {
namespace {

TEST(VoxelKey, FloorIsTheLibrarys) {
  for (const float x : {0.0f, -0.0f, 0.5f, -0.5f, 1.0f, -1.0f, -1.0000001f, 41.99999f, -42.00001f,
                        1e6f, -1e6f, -1e-30f}) {
    EXPECT_EQ(FloorToInt(x), static_cast<std::int32_t>(std::floor(x))) << x;
  }
}

TEST(VoxelKey, DifferentVoxelsHaveDifferentKeys) {
  constexpr std::int32_t kFar = kVoxelCoordinateLimit - 1;
  std::unordered_set<VoxelKey> keys;
  std::size_t num_voxels = 0;
  for (const std::int32_t x : {-kFar, -1, 0, 1, kFar}) {
    for (const std::int32_t y : {-kFar, -1, 0, 1, kFar}) {
      for (const std::int32_t z : {-kFar, -1, 0, 1, kFar}) {
        keys.insert(PackVoxel(x, y, z));
        ++num_voxels;
      }
    }
  }
  EXPECT_EQ(keys.size(), num_voxels);
}

TEST(VoxelKey, AKeyTellsItsVoxel) {
  constexpr std::int32_t kFar = kVoxelCoordinateLimit - 1;
  for (const VoxelCell& voxel :
       {VoxelCell{0, 0, 0}, VoxelCell{1, -2, 3}, VoxelCell{-kFar, kFar, -1},
        VoxelCell{kFar, 0, kFar}, VoxelCell{-1, -kVoxelCoordinateLimit, kFar}}) {
    EXPECT_EQ(UnpackVoxel(PackVoxel(voxel[0], voxel[1], voxel[2])), voxel);
  }
}

// Clouds hold such coordinates where a driver marks a missing return.
TEST(VoxelKey, CoordinatesFarAwayOrNoNumbersLieAtTheLimit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(VoxelOf({kNan, kInfinity, -kInfinity}),
            (VoxelCell{kVoxelCoordinateLimit, kVoxelCoordinateLimit, -kVoxelCoordinateLimit}));
  EXPECT_EQ(VoxelOf({1e300, -1e300, -0.5}),
            (VoxelCell{kVoxelCoordinateLimit, -kVoxelCoordinateLimit, -1}));
}

// A street's voxels are spread over the slots of a table twice as large: a random hash leaves 0.39
// of the slots' runs alone; clusters would show as long searches.
TEST(VoxelKey, NeighbouringVoxelsSpreadOverTheTable) {
  constexpr std::size_t kSlots = 1u << 15;
  std::vector<int> hits(kSlots, 0);
  int num_voxels = 0;
  for (std::int32_t x = -64; x < 64; ++x) {
    for (std::int32_t y = -32; y < 32; ++y) {
      for (std::int32_t z = 0; z < 2; ++z) {
        ++hits[HashVoxel(PackVoxel(x, y, z)) & (kSlots - 1)];
        ++num_voxels;
      }
    }
  }
  double search = 0;  // mean number of others in a voxel's own slot; 0.5 by chance
  for (const int n : hits) search += static_cast<double>(n) * (n - 1) / num_voxels;
  EXPECT_LT(search, 1.0);
}

TEST(VoxelKey, OnlyPointsWithinTheLimitHaveAVoxel) {
  EXPECT_TRUE(IsVoxel({0.5, -1e6, 1e6}));
  EXPECT_FALSE(IsVoxel({0.5, 0.5, 1.1e6}));
  EXPECT_FALSE(IsVoxel({-1e30, 0.5, 0.5}));
  EXPECT_FALSE(IsVoxel({0.5, std::numeric_limits<double>::quiet_NaN(), 0.5}));
}

}  // namespace
}  // namespace lio
