// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the promises of matching against keyframes alone; test/contract/matcher_contract_test.cpp
// has those of every matcher.
#include "lio/registration/gicp_matcher.hpp"

#include <gtest/gtest.h>

#include <random>

namespace lio {
namespace {

// Returns points on all six sides of a box of that half width around the sensor.
std::vector<Eigen::Vector3f> BoxAround(float half_m, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-half_m, half_m);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 3000; ++i) {
    Eigen::Vector3f point = {place(random), place(random), place(random)};
    point[i % 3] = i % 2 == 0 ? half_m : -half_m;
    points.push_back(point);
  }
  return points;
}

Pose At(double x, double yaw_deg = 0.0) {
  return {ExpSo3(Vector3(0, 0, yaw_deg * M_PI / 180.0)), {x, 0, 0}};
}

// Ranges on a cube's face begin at the half width: their median is 1.2 to 1.3 of it.
TEST(GicpMatcher, OpennessIsTheMedianRangeSmoothed) {
  GicpMatcher matcher{GicpOptions{}};
  EXPECT_EQ(matcher.openness_m(), 0.0);
  const auto near = BoxAround(4.f), far = BoxAround(40.f);
  matcher.Insert({near}, At(0));
  const double first = matcher.openness_m();
  EXPECT_GT(first, 4.0 * 1.2);
  EXPECT_LT(first, 4.0 * 1.35);
  MatchInput input;
  input.points_imu = far;
  (void)matcher.Match(input);
  const double ten_times = 10.0 * first;  // the same box, ten times as large
  EXPECT_NEAR(matcher.openness_m(), 0.9 * first + 0.1 * ten_times, 0.02);
}

// A tenth of an openness of 12 m gives a keyframe every 1.2 m.
TEST(GicpMatcher, KeyframesAreAShareOfTheOpennessApart) {
  GicpMatcher matcher{GicpOptions{}};
  const auto scan = BoxAround(10.f);
  matcher.Insert({scan}, At(0));
  const double apart_m = 0.1 * matcher.openness_m();
  matcher.Insert({scan}, At(0.95 * apart_m));
  EXPECT_EQ(matcher.num_keyframes(), 1u);
  matcher.Insert({scan}, At(1.05 * apart_m));
  EXPECT_EQ(matcher.num_keyframes(), 2u);
}

TEST(GicpMatcher, KeyframesStayWithinTheirLimits) {
  for (const float half_m : {1.f, 90.f}) {
    GicpOptions options;
    GicpMatcher matcher(options);
    const auto scan = BoxAround(half_m);
    const double apart_m = half_m < 10.f ? options.min_keyframe_m : options.max_keyframe_m;
    matcher.Insert({scan}, At(0));
    matcher.Insert({scan}, At(apart_m - 0.05));
    EXPECT_EQ(matcher.num_keyframes(), 1u) << half_m;
    matcher.Insert({scan}, At(apart_m + 0.05));
    EXPECT_EQ(matcher.num_keyframes(), 2u) << half_m;
  }
}

TEST(GicpMatcher, TurningMakesAKeyframe) {
  GicpMatcher matcher{GicpOptions{}};
  const auto scan = BoxAround(10.f);
  matcher.Insert({scan}, At(0));
  matcher.Insert({scan}, At(0, 14.0));
  EXPECT_EQ(matcher.num_keyframes(), 1u);
  matcher.Insert({scan}, At(0, 16.0));
  EXPECT_EQ(matcher.num_keyframes(), 2u);
}

// A scan that is not inserted adds nothing to the map.
TEST(GicpMatcher, BetweenKeyframesThereIsNoNewContent) {
  GicpMatcher matcher{GicpOptions{}};
  const auto map = BoxAround(5.f, 1), scan = BoxAround(5.f, 2);
  matcher.Insert({map}, At(0));
  MatchInput input;
  input.points_imu = scan;
  input.T_map_imu_guess = At(0.05);
  input.guess_cov = 0.01 * Matrix6::Identity();
  const MatchResult result = matcher.Match(input);
  ASSERT_TRUE(result.IsUsable());
  EXPECT_LT(result.T_map_imu.translation.norm(), 0.02);
  EXPECT_EQ(result.new_content_share, 0.0);
}

// Beams hit a wall in the box, but so few of them that no surface is found.
int NumMatchedWithStrayPoints(bool has_ends, double shift_std_m) {
  std::vector<Eigen::Vector3f> box = BoxAround(4.f);
  if (!has_ends) std::erase_if(box, [](const auto& p) { return std::abs(p.x()) == 4.f; });
  std::vector<Eigen::Vector3f> map = box;
  for (int i = 0; i < 400; ++i) {
    map.emplace_back(1.f, 0.1f * static_cast<float>(i % 20) - 1.f,
                     0.1f * static_cast<float>(i / 20) - 1.f);  // NOLINT(bugprone-integer-division)
  }
  std::vector<Eigen::Vector3f> scan = box;
  for (const float y : {-0.8f, 0.f, 0.8f}) scan.emplace_back(1.05f, y, 0.f);
  GicpMatcher matcher{GicpOptions{}};
  matcher.Insert({map}, At(0));
  MatchInput input;
  input.points_imu = scan;
  input.shift_std_m = shift_std_m;
  return matcher.Match(input).num_matched;
}

TEST(GicpMatcher, PointsOfNoSurfaceCountOnlyWhereNothingElseHoldsThePose) {
  const int num_in_box = NumMatchedWithStrayPoints(true, 0.01);
  EXPECT_EQ(NumMatchedWithStrayPoints(true, 0.3), num_in_box);
  const int num_in_corridor = NumMatchedWithStrayPoints(false, 0.01);
  EXPECT_GE(NumMatchedWithStrayPoints(false, 0.3), num_in_corridor + 3);
}

TEST(GicpMatcher, ClearForgetsKeyframesAndOpenness) {
  GicpMatcher matcher{GicpOptions{}};
  const auto scan = BoxAround(5.f);
  matcher.Insert({scan}, At(0));
  EXPECT_GT(matcher.map_size().num_cells, 500u);
  matcher.Clear();
  EXPECT_EQ(matcher.num_keyframes(), 0u);
  EXPECT_EQ(matcher.openness_m(), 0.0);
  EXPECT_EQ(matcher.map_size().num_cells, 0u);
}

}  // namespace
}  // namespace lio
