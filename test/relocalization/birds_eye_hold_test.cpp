// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/birds_eye_hold.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/standing_things.hpp"

namespace lio {
namespace {

// Returns posts at random places beside a road along x, seen from a point on it.
test::Points RoadsidePosts(float x_m) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<float> along(-60.f, 60.f);
  std::uniform_real_distribution<float> across(8.f, 30.f);
  test::Points points;
  for (int i = 0; i < 80; ++i) {
    const float x = along(random);
    test::AddPost({x, (i % 2 == 0 ? 1.f : -1.f) * across(random)}, {x_m, 0.f}, points);
  }
  return points;
}

MatchResult MatchAt(double x_m, double along_std_m) {
  MatchResult match;
  match.status = MatchStatus::kDegenerate;
  match.T_map_imu.translation.x() = x_m;
  match.cov = 1e-4 * Matrix6::Identity();
  match.cov(0, 0) = along_std_m * along_std_m;
  match.degenerate_mask = along_std_m > 0.5 ? 1u : 0u;
  return match;
}

TEST(BirdsEyeHold, PutsADegenerateMatchWhereThePostsSay) {
  BirdsEyeHold hold;
  for (int i = 0; i < 3; ++i) {
    MatchResult match = MatchAt(2.0 * i, 0.05);
    hold.Apply(RoadsidePosts(2.f * static_cast<float>(i)), Quaternion::Identity(), match);
    EXPECT_EQ(match.T_map_imu.translation.x(), 2.0 * i) << "nothing was degenerate";
  }
  MatchResult match = MatchAt(4.8, 1.5);  // truth: 6 m
  hold.Apply(RoadsidePosts(6.f), Quaternion::Identity(), match);
  EXPECT_NEAR(match.T_map_imu.translation.x(), 6.0, 0.25);
  EXPECT_LT(std::sqrt(match.cov(0, 0)), 0.5);
}

TEST(BirdsEyeHold, WithoutEarlierViewsAMatchStaysAsItIs) {
  BirdsEyeHold hold;
  MatchResult match = MatchAt(1.0, 1.5);
  hold.Apply(RoadsidePosts(0.f), Quaternion::Identity(), match);
  EXPECT_EQ(match.T_map_imu.translation.x(), 1.0);
  EXPECT_EQ(match.cov(0, 0), 2.25);
}

}  // namespace
}  // namespace lio
