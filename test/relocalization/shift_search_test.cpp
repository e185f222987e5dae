// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/shift_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/standing_things.hpp"

namespace lio {
namespace {

using test::AddPost;
using test::AddRings;
using test::Points;

// Returns posts at random places and rails on both sides of the road along x.
Points RoadWithRails(const Eigen::Vector2f& sensor) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<float> along(-60.f, 60.f);
  std::uniform_real_distribution<float> across(8.f, 30.f);
  Points points;
  AddRings(points);
  for (int i = 0; i < 80; ++i) {
    const float x = along(random);
    AddPost({x, (i % 2 == 0 ? 1.f : -1.f) * across(random)}, sensor, points);
  }
  for (float x = -60.f; x < 60.f; x += 0.2f) AddPost({x, 6.f}, sensor, points);
  return points;
}

// Returns a pattern that moves with the sensor, and two walls.
Points Tunnel() {
  Points points;
  for (int i = 0; i < 60; ++i) {
    const float x = 1.5f * static_cast<float>(i - 30) + 0.4f * std::sin(static_cast<float>(i * i));
    AddPost({x, i % 2 == 0 ? 5.f : -5.f}, {0.f, 0.f}, points);
  }
  return points;
}

template <class Place>
std::vector<PlacedView> Views(const Place& points_at, int num) {
  std::vector<PlacedView> views;
  for (int i = 0; i < num; ++i) {
    const Eigen::Vector2f position_m(2.f * static_cast<float>(i), 0.f);
    views.push_back({position_m, BirdsEyeView(points_at(position_m))});
  }
  return views;
}

TEST(ShiftSearch, FindsHowFarTheSensorHasGoneAlongARoad) {
  for (const int num_views : {1, 4, 8}) {
    const std::vector<PlacedView> earlier = Views(RoadWithRails, num_views);
    const Eigen::Vector2f truth_m(2.f * static_cast<float>(num_views) + 0.7f, 0.2f);
    const auto found = FindShift(earlier, BirdsEyeView(RoadWithRails(truth_m)),
                                 truth_m + Eigen::Vector2f(-2.2f, 0.4f), 4.f);
    ASSERT_TRUE(found);
    EXPECT_LT((found->position_m - truth_m.cast<double>()).norm(), 0.25) << num_views;
    EXPECT_LT(std::sqrt(found->cov.diagonal().maxCoeff()), 0.5) << num_views;
  }
}

// Rails alone determine the lateral position, but not the one along them.
TEST(ShiftSearch, SaysThatAPieceOfRoadLooksTheSame) {
  const auto rails = [](const Eigen::Vector2f& sensor) {
    Points points;
    for (float x = -59.f; x < 59.f; x += 0.2f) {
      AddPost({sensor.x() + x, 6.f}, sensor, points);
      AddPost({sensor.x() + x, -7.f}, sensor, points);
    }
    return points;
  };
  const std::vector<PlacedView> earlier = Views(rails, 3);
  const auto found = FindShift(earlier, BirdsEyeView(rails({6.f, 0.3f})), {5.f, 0.f}, 4.f);
  if (found) {
    EXPECT_GT(std::sqrt(found->cov(0, 0)), 1.0);
  }
}

TEST(ShiftSearch, IsNotDeceivedByWhatMovesWithTheSensor) {
  const std::vector<PlacedView> earlier = Views([](const auto&) { return Tunnel(); }, 4);
  EXPECT_FALSE(FindShift(earlier, BirdsEyeView(Tunnel()), {8.f, 0.f}, 5.f));
}

TEST(ShiftSearch, SaysNothingWhereNothingStandsOrNothingWasSeen) {
  Points bare;
  AddRings(bare);
  EXPECT_FALSE(FindShift(Views(RoadWithRails, 2), BirdsEyeView(bare), {4.f, 0.f}, 4.f));
  EXPECT_FALSE(FindShift({}, BirdsEyeView(RoadWithRails({0.f, 0.f})), {0.f, 0.f}, 4.f));
}

}  // namespace
}  // namespace lio
