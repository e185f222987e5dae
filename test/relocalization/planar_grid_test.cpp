// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/planar_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

using Structures = std::vector<Eigen::Vector2f>;

TEST(PlanarGrid, AllPosesAroundTheMiddleAreVisitedOnce) {
  const PlanarGrid grid{{Eigen::Vector2f(10.f, -5.f), 0.5f}, 2, 1, 1, 0.25f, 0.1f};
  std::vector<PlanarPose> poses;
  ForEachPose({}, grid, [&](const Structures&, const PlanarPose& pose) { poses.push_back(pose); });
  ASSERT_EQ(poses.size(), 5U * 3U * 3U);
  const PlanarPose& first = poses.front();
  EXPECT_FLOAT_EQ(first.shift_m.x(), 9.5f);
  EXPECT_FLOAT_EQ(first.shift_m.y(), -5.25f);
  EXPECT_FLOAT_EQ(first.turn_rad, 0.4f);
  EXPECT_FLOAT_EQ(poses[1].shift_m.x(), 9.75f);  // x first
  EXPECT_FLOAT_EQ(poses[5].shift_m.y(), -5.f);   // then y
  EXPECT_FLOAT_EQ(poses[15].turn_rad, 0.5f);     // then the turn
  const PlanarPose& middle = poses[22];
  EXPECT_EQ(middle.shift_m, grid.middle.shift_m);
  EXPECT_EQ(middle.turn_rad, grid.middle.turn_rad);
}

TEST(PlanarGrid, StructuresAreTurnedAboutTheirOriginAndNotShifted) {
  const PlanarGrid grid{{Eigen::Vector2f(100.f, 100.f), static_cast<float>(M_PI / 2)}};
  int num_visits = 0;
  const auto visit = [&](const Structures& turned, const PlanarPose&) {
    ++num_visits;
    ASSERT_EQ(turned.size(), 2U);
    EXPECT_LT((turned[0] - Eigen::Vector2f(0.f, 3.f)).norm(), 1e-5f);
    EXPECT_LT((turned[1] - Eigen::Vector2f(-2.f, 0.f)).norm(), 1e-5f);
  };
  ForEachPose({Eigen::Vector2f(3.f, 0.f), Eigen::Vector2f(0.f, 2.f)}, grid, visit);
  EXPECT_EQ(num_visits, 1);
}

}  // namespace
}  // namespace lio
