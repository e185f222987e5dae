// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/point_filter.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lio {
namespace {

LidarPoint At(float x, float y, float z) {
  LidarPoint point;
  point.x_m = x, point.y_m = y, point.z_m = z;
  return point;
}

TEST(PointFilter, OneBadCoordinateMakesAPointNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(IsFinite(At(1, -2, 3)));
  for (const float bad : {nan, infinity, -infinity}) {
    EXPECT_FALSE(IsFinite(At(bad, 0, 0)));
    EXPECT_FALSE(IsFinite(At(0, bad, 0)));
    EXPECT_FALSE(IsFinite(At(0, 0, bad)));
  }
  EXPECT_FALSE(IsFinite(At(infinity, -infinity, 0)));
}

TEST(PointFilter, RangeIsThatInSpaceLimitsIncluded) {
  LidarRig rig;
  rig.min_range_m = 3.0;
  rig.max_range_m = 9.0;
  const PointFilter filter(rig);
  EXPECT_TRUE(filter.IsWanted(At(1, 2, 2)));  // 3
  EXPECT_FALSE(filter.IsWanted(At(1, 2, 1.9f)));
  EXPECT_TRUE(filter.IsWanted(At(-4, 7, -4)));  // 9
  EXPECT_FALSE(filter.IsWanted(At(-4, 7, -4.1f)));
}

TEST(PointFilter, TheVehicleItselfIsLeftOutItsFacesIncluded) {
  LidarRig rig;
  rig.min_range_m = 0.0;
  rig.own_vehicle_box = OwnVehicleBox{{-2, -1, -1.5}, {2, 1, 0}};
  const PointFilter filter(rig);
  EXPECT_FALSE(filter.IsWanted(At(0.5f, 0.5f, -0.5f)));
  EXPECT_FALSE(filter.IsWanted(At(2, 1, 0)));
  EXPECT_TRUE(filter.IsWanted(At(2.01f, 0.5f, -0.5f)));
  EXPECT_TRUE(filter.IsWanted(At(0.5f, 1.01f, -0.5f)));
  EXPECT_TRUE(filter.IsWanted(At(0.5f, 0.5f, 0.01f)));
  EXPECT_TRUE(PointFilter(LidarRig{}).IsWanted(At(1.6f, 0.5f, -0.5f))) << "without a box";
}

}  // namespace
}  // namespace lio
