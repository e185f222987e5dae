// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "map/convex_hull.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lio {
namespace {

using ::testing::ElementsAre;
using Places = std::vector<Eigen::Vector2d>;

TEST(ConvexHull, CornersGoAgainstTheClockFromTheLeftmost) {
  const Places places{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}};
  EXPECT_THAT(ConvexHull(places), ElementsAre(0, 1, 2, 3));
}

TEST(ConvexHull, PlacesOnASideAreNoCorners) {
  const Places places{{0, 0}, {1, 0}, {2, 0}, {1, 3}};
  EXPECT_THAT(ConvexHull(places), ElementsAre(0, 2, 3));
}

TEST(ConvexHull, FewerThanThreePlacesAreAllOfIt) {
  EXPECT_THAT(ConvexHull({}), ElementsAre());
  EXPECT_THAT(ConvexHull({{3, 1}, {1, 1}}), ElementsAre(1, 0));
}

TEST(ConvexHull, PlacesOnALineHaveTheirEnds) {
  EXPECT_THAT(ConvexHull({{0, 0}, {1, 1}, {2, 2}, {3, 3}}), ElementsAre(0, 3));
}

TEST(ConvexHull, AllPlacesAreWithinIt) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Places places;
  for (int i = 0; i < 200; ++i) places.emplace_back(normal(random), normal(random));
  const auto hull = ConvexHull(places);
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Eigen::Vector2d corner = places[hull[k]];
    const Eigen::Vector2d side = places[hull[(k + 1) % hull.size()]] - corner;
    for (const Eigen::Vector2d& place : places) {
      const Eigen::Vector2d to = place - corner;
      EXPECT_GE(side.x() * to.y() - side.y() * to.x(), -1e-12);
    }
  }
}

}  // namespace
}  // namespace lio
