// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/structure_pyramid.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace lio {
namespace {

std::vector<Eigen::Vector3f> SomePoints(const Eigen::Vector3f& half_extent_m) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> coordinate(-1.f, 1.f);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 60; ++i) {
    const float x = coordinate(random);
    const float y = coordinate(random);
    points.push_back(half_extent_m.cwiseProduct(Eigen::Vector3f(x, y, coordinate(random))));
  }
  return points;
}

StructurePyramid OfTown() {
  std::vector<Eigen::Vector2f> things;
  for (const Eigen::Vector3f& point : SomePoints({80.f, 80.f, 0.f})) {
    things.emplace_back(point.head<2>());
  }
  return StructurePyramid::FromAbove(things);
}

StructurePyramid OfBuilding() {
  return StructurePyramid::InBuilding(SomePoints({12.f, 9.f, 4.f}));
}

TEST(StructurePyramid, ThingsStandWhereThePointsAre) {
  const StructurePyramid town = OfTown();
  EXPECT_TRUE(town.is_flat());
  for (const Eigen::Vector3f& point : SomePoints({80.f, 80.f, 0.f})) {
    const Eigen::Vector3i cell = town.CellOf(point);
    EXPECT_TRUE(town.MayStand(0, cell));
    EXPECT_TRUE(town.Stands(cell));
    EXPECT_LT((town.CentreOf(cell) - point).cwiseAbs().maxCoeff(), 0.2501f);
  }
  EXPECT_FALSE(town.MayStand(0, town.CellOf({-85.f, 0.f, 0.f}))) << "in the margin";
  EXPECT_FALSE(town.MayStand(0, town.CellOf({500.f, 0.f, 0.f})));
}

TEST(StructurePyramid, PointsOfABuildingHaveHeights) {
  const StructurePyramid building = OfBuilding();
  EXPECT_FALSE(building.is_flat());
  const Eigen::Vector3f point(1.f, 2.f, 3.1f);
  const StructurePyramid one = StructurePyramid::InBuilding(std::vector{point});
  const float reach_m = one.scale().reach_cells * one.scale().cell_m;
  EXPECT_TRUE(one.MayStand(0, one.CellOf(point)));
  EXPECT_TRUE(one.MayStand(0, one.CellOf(point + Eigen::Vector3f(0.f, 0.f, reach_m))));
  EXPECT_FALSE(one.MayStand(0, one.CellOf(point + Eigen::Vector3f(0.f, 0.f, 1.f))));
}

// Branch and bound is exact only if no bound is too low: all cells, beyond the borders, too.
void ExpectBounds(const StructurePyramid& pyramid, int spacing) {
  const Eigen::Vector3i size = pyramid.size();
  int num_standing = 0;
  for (int level = 1; level < pyramid.scale().num_levels; ++level) {
    const int step = 1 << level;
    const int layers = pyramid.is_flat() ? 1 : step;
    const auto stands = [&](const Eigen::Vector3i& from) {
      for (int dz = 0; dz < layers; ++dz) {
        for (int dy = 0; dy < step; ++dy) {
          for (int dx = 0; dx < step; ++dx) {
            if (pyramid.MayStand(0, from + Eigen::Vector3i(dx, dy, dz))) return true;
          }
        }
      }
      return false;
    };
    for (int z = pyramid.is_flat() ? 0 : -step - 3; z < size.z(); z += spacing) {
      for (int y = -step - 3; y < size.y() + 3; y += spacing) {
        for (int x = -step - 3; x < size.x() + 3; x += spacing) {
          if (!stands({x, y, z})) continue;
          ++num_standing;
          ASSERT_TRUE(pyramid.MayStand(level, {x, y, z})) << level << ": " << x << ' ' << y << z;
        }
      }
    }
  }
  EXPECT_GT(num_standing, 50);
}

TEST(StructurePyramid, CoarseLevelsBoundAllShiftsBelowThem) {
  ExpectBounds(OfTown(), 5);
  ExpectBounds(OfBuilding(), 7);
}

TEST(StructurePyramid, NothingStandsWithoutPoints) {
  for (const StructurePyramid& pyramid :
       {StructurePyramid::FromAbove({}), StructurePyramid::InBuilding({})}) {
    for (int level = 0; level < pyramid.scale().num_levels; ++level) {
      EXPECT_FALSE(pyramid.MayStand(level, {3, 3, 0}));
    }
  }
}

TEST(StructurePyramid, RefusesPointsFartherApartThanItsGridsReach) {
  const std::vector<Eigen::Vector2f> apart{{0.f, 0.f}, {0.f, 5000.f}};
  EXPECT_THROW((void)StructurePyramid::FromAbove(apart), std::invalid_argument);
}

// The program says beforehand that wider maps are unusable (pipeline/initial_map.cpp).
TEST(StructurePyramid, TakesPointsAsFarApartAsAMapMayBe) {
  constexpr MapSearchScale kScale = MapSearchParameters::kFromAbove;
  const float most_m =
      kScale.cell_m * static_cast<float>(kRelocalization.map_search.max_cells_per_side) -
      2.f * kScale.margin_m;
  const std::vector<Eigen::Vector2f> apart{{0.f, 0.f}, {0.f, most_m - 0.01f}};
  EXPECT_NO_THROW((void)StructurePyramid::FromAbove(apart));
}

TEST(StructurePyramid, AStreetIsNoBuilding) {
  EXPECT_TRUE(StructurePyramid::IsOfBuilding(SomePoints({20.f, 15.f, 5.f})));
  EXPECT_FALSE(StructurePyramid::IsOfBuilding(SomePoints({300.f, 50.f, 10.f})));
}

}  // namespace
}  // namespace lio
