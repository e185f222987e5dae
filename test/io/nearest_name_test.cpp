// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/nearest_name.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lio {
namespace {

TEST(EditDistance, CountsInsertDeleteSubstituteAndSwap) {
  EXPECT_EQ(EditDistance("", ""), 0);
  EXPECT_EQ(EditDistance("abc", ""), 3);
  EXPECT_EQ(EditDistance("voxel", "voxel_m"), 2);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("voxle", "voxel"), 1);
}

TEST(NearestName, FindsTypingMistakesAndNamesOfOtherGroups) {
  const std::vector<std::string> names = {"ndt.max_cells", "ndt.voxel_m", "rig.gravity_mps2"};
  EXPECT_EQ(NearestName("ndt.voxle_m", names), "ndt.voxel_m");
  EXPECT_EQ(NearestName("gravity_mps", names), "rig.gravity_mps2");
  EXPECT_EQ(NearestName("x", {}), "");
}

TEST(NearestName, ALeftOutUnitIsASmallMistake) {
  const std::vector<std::string> names = {"T.rotation_wxyz", "T.rotation_rpy_deg", "ndt.voxel_m"};
  EXPECT_EQ(NearestName("T.rotation_rpy", names), "T.rotation_rpy_deg");
  EXPECT_EQ(NearestName("rotation_rpy", names), "T.rotation_rpy_deg");
}

}  // namespace
}  // namespace lio
