// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/standing_points.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/standing_things.hpp"

namespace lio {
namespace {

using test::Points;

TEST(StandingPoints, ColumnStandsAndGroundDoesNot) {
  Points points;
  test::AddRings(points);
  test::AddColumn({20.3f, 3.4f}, points);
  const auto standing = StandingPoints(points);
  ASSERT_FALSE(standing.empty());
  for (const Eigen::Vector2f& point : standing) {
    EXPECT_LT((point - Eigen::Vector2f(20.3f, 3.4f)).norm(), 0.22f);
  }
}

// A floor below a ceiling spreads over the height, but not within a metre.
TEST(StandingPoints, FloorBelowACeilingDoesNotStand) {
  Points points;
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 40; ++y) {
      const Eigen::Vector2f place(0.2f * static_cast<float>(x), 0.2f * static_cast<float>(y));
      points.emplace_back(place.x(), place.y(), 0.05f);
      points.emplace_back(place.x(), place.y(), 2.6f);
    }
  }
  EXPECT_TRUE(StandingPoints(points).empty());
}

TEST(StandingPoints, PointsThatAreNoNumbersDoNoHarm) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(StandingPoints(Points{{nan, nan, nan}, {1.f, 1.f, 1.f}}).empty());
}

TEST(ColumnMeans, OnePointForEachColumnInTheirOrder) {
  const std::vector<Eigen::Vector2f> points{
      {3.1f, 0.1f}, {0.1f, 0.1f}, {3.3f, 0.3f}, {-0.1f, 0.1f}};
  const auto means = ColumnMeans(points);
  ASSERT_EQ(means.size(), 3u);
  EXPECT_LT((means[0] - Eigen::Vector2f(3.2f, 0.2f)).norm(), 1e-6f);
  EXPECT_EQ(means[1], points[1]);
  EXPECT_EQ(means[2], points[3]);
}

}  // namespace
}  // namespace lio
