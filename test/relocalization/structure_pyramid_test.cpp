// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/structure_pyramid.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr MapSearchParameters kSearch = kRelocalization.map_search;

std::vector<Eigen::Vector2f> SomePoints() {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> coordinate(-70.f, 90.f);
  std::vector<Eigen::Vector2f> points;
  for (int i = 0; i < 60; ++i) {
    const float x = coordinate(random);
    points.emplace_back(x, coordinate(random));
  }
  return points;
}

TEST(StructurePyramid, ThingsStandWhereThePointsAre) {
  const auto points = SomePoints();
  const StructurePyramid pyramid(points);
  for (const Eigen::Vector2f& point : points) {
    EXPECT_TRUE(pyramid.MayStand(0, pyramid.CellOf(point)));
    EXPECT_LT((pyramid.CentreOf(pyramid.CellOf(point)) - point).cwiseAbs().maxCoeff(), 0.2501f);
  }
  EXPECT_FALSE(pyramid.MayStand(0, pyramid.CellOf({-78.f, 0.f}))) << "in the margin";
  EXPECT_FALSE(pyramid.MayStand(0, pyramid.CellOf({500.f, 0.f})));
}

// Branch and bound is exact only if no bound is too low: all cells, beyond the borders, too.
TEST(StructurePyramid, CoarseLevelsBoundAllShiftsBelowThem) {
  const StructurePyramid pyramid(SomePoints());
  for (int level = 1; level < kSearch.num_levels; ++level) {
    const int step = 1 << level;
    for (int y = -step - 3; y < pyramid.size().y() + 3; y += 5) {
      for (int x = -step - 3; x < pyramid.size().x() + 3; x += 5) {
        bool stands = false;
        for (int dy = 0; dy < step && !stands; ++dy) {
          for (int dx = 0; dx < step && !stands; ++dx) {
            stands = pyramid.MayStand(0, {x + dx, y + dy});
          }
        }
        if (stands) {
          ASSERT_TRUE(pyramid.MayStand(level, {x, y})) << level << ": " << x << ", " << y;
        }
      }
    }
  }
}

TEST(StructurePyramid, NothingStandsWithoutPoints) {
  const StructurePyramid pyramid({});
  for (int level = 0; level < kSearch.num_levels; ++level) {
    EXPECT_FALSE(pyramid.MayStand(level, {3, 3}));
  }
}

TEST(StructurePyramid, RefusesPointsFartherApartThanItsGridsReach) {
  const std::vector<Eigen::Vector2f> apart{{0.f, 0.f}, {0.f, 5000.f}};
  EXPECT_THROW(StructurePyramid{apart}, std::invalid_argument);
}

}  // namespace
}  // namespace lio
