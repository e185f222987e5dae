// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/birds_eye_view.hpp"

#include <gtest/gtest.h>

#include "support/standing_things.hpp"

namespace lio {
namespace {

using test::AddPost;
using test::AddRings;
using test::Points;

bool IsNear(const BirdsEyeView& view, const Eigen::Vector2f& place) {
  return view.NumNear({&place, 1}, Eigen::Vector2f::Zero()) == 1;
}

bool IsRoughlyNear(const BirdsEyeView& view, const Eigen::Vector2f& place) {
  return view.NumRoughlyNear({&place, 1}, Eigen::Vector2f::Zero()) == 1;
}

TEST(BirdsEyeView, DoesNotCountGround) {
  Points points;
  AddRings(points);
  EXPECT_TRUE(BirdsEyeView(points).structures().empty());
  AddPost({7.f, 3.f}, {0.f, 0.f}, points);
  const BirdsEyeView view(points);
  ASSERT_EQ(view.structures().size(), 1u);
  EXPECT_TRUE(IsNear(view, {7.1f, 2.9f}));
  EXPECT_FALSE(IsNear(view, {8.f, 3.f}));
}

// A wall does not determine the position along it, so isolated objects are chosen if there are
// enough.
TEST(BirdsEyeView, LeavesWallsOutWhereEnoughStandsAlone) {
  Points points;
  for (float x = -30.f; x < 30.f; x += 0.2f) AddPost({x, 12.f}, {0.f, 0.f}, points);
  for (int i = 0; i < 50; ++i) {
    AddPost({-50.f + 2.f * static_cast<float>(i), i % 2 == 0 ? -9.f : -17.f}, {0.f, 0.f}, points);
  }
  const BirdsEyeView view(points);
  EXPECT_TRUE(IsNear(view, {0.f, 12.f}));
  int num_of_wall = 0;
  for (const Eigen::Vector2f& place : view.structures()) num_of_wall += place.y() > 11.f ? 1 : 0;
  EXPECT_LE(num_of_wall, 12);  // its ends
  EXPECT_GE(view.structures().size(), 50u);
}

TEST(BirdsEyeView, OfWhatIsHighLeavesTheRestOut) {
  Points points;
  AddPost({7.f, 3.f}, {0.f, 0.f}, points);  // 2.1 m high
  EXPECT_EQ(BirdsEyeView(points, 2.f).structures().size(), 1u);
  EXPECT_TRUE(BirdsEyeView(points, 2.2f).structures().empty());
}

TEST(BirdsEyeView, SaysEnoughFromTwentyThings) {
  Points points;
  for (int i = 0; i < 19; ++i) AddPost({3.f * static_cast<float>(i), 8.f}, {0.f, 0.f}, points);
  EXPECT_FALSE(BirdsEyeView(points).HasEnoughStructures());
  AddPost({3.f, -8.f}, {0.f, 0.f}, points);
  EXPECT_TRUE(BirdsEyeView(points).HasEnoughStructures());
}

TEST(BirdsEyeView, RoughlyNearReachesFartherThanNear) {
  Points points;
  AddPost({7.f, 3.f}, {0.f, 0.f}, points);
  const BirdsEyeView view(points);
  EXPECT_TRUE(IsRoughlyNear(view, {8.f, 3.f}));
  EXPECT_FALSE(IsNear(view, {8.f, 3.f}));
  EXPECT_FALSE(IsRoughlyNear(view, {11.f, 3.f}));
  EXPECT_FALSE(IsNear(view, {200.f, 3.f}));  // outside the view
}

TEST(SpreadEvenly, KeepsAllOfFewAndSpreadsOverMany) {
  std::vector<Eigen::Vector2f> places;
  EXPECT_TRUE(SpreadEvenly(places, 5).empty());
  for (int i = 0; i < 10; ++i) places.emplace_back(static_cast<float>(i), 0.f);
  EXPECT_EQ(SpreadEvenly(places, 12), places);
  const auto chosen = SpreadEvenly(places, 5);
  ASSERT_EQ(chosen.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(chosen[i].x(), 2.f * static_cast<float>(i));
}

TEST(BirdsEyeView, CountsPlacesAsMoved) {
  Points points;
  AddPost({7.f, 3.f}, {0.f, 0.f}, points);
  AddPost({-9.f, 3.f}, {0.f, 0.f}, points);
  const BirdsEyeView view(points);
  const std::vector<Eigen::Vector2f> places{{6.f, 5.f}, {-10.f, 5.f}, {20.f, 5.f}};
  EXPECT_EQ(view.NumNear(places, {1.f, -2.f}), 2);
  EXPECT_EQ(view.NumNear(places, {0.f, 0.f}), 0);
  EXPECT_EQ(view.NumRoughlyNear(places, {0.8f, -1.8f}), 2);
}

}  // namespace
}  // namespace lio
