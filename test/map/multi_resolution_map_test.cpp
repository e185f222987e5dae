// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/multi_resolution_map.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace lio {
namespace {

const Vector3 kSensor = Vector3::Zero();

NdtOptions TwoLevels() {
  NdtOptions options;
  options.voxel_m = 1.0;
  options.num_levels = 2;
  return options;
}

// Points of the wall x = `at_m`, from -`half_m` to `half_m` in y and z.
std::vector<Vector3> Wall(double at_m, double half_m, int num) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-half_m, half_m);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<Vector3> points;
  for (int i = 0; i < num; ++i) {
    const double y = place(random);
    const double z = place(random);
    points.emplace_back(at_m + noise(random), y, z);
  }
  return points;
}

GaussianMap::Hit FindOne(const MultiResolutionMap& map, const Vector3& point, std::size_t finest) {
  GaussianMap::Hit hit;
  map.FindAll({&point, 1}, {finest, map.num_levels() - 1}, {&hit, 1});
  return hit;
}

TEST(MultiResolutionMap, RefusesNoLevelAndMoreThanAreCounted) {
  NdtOptions options = TwoLevels();
  options.num_levels = 0;
  EXPECT_THROW(MultiResolutionMap{options}, std::invalid_argument);
  options.num_levels = static_cast<int>(kMaxMapLevels) + 1;
  EXPECT_THROW(MultiResolutionMap{options}, std::invalid_argument);
}

TEST(MultiResolutionMap, APointIsFoundAtTheFinestLevelThatShowsASurface) {
  MultiResolutionMap map(TwoLevels());
  // The wall has 100 points a square metre: 25 in a cell of 0.5 m.
  map.Insert(Wall(5.3, 2.0, 1600), kSensor);
  const GaussianMap::Hit fine = FindOne(map, {5.3, 0.2, 0.2}, 0);
  ASSERT_NE(fine.cell, MultiResolutionMap::kNoCell);
  EXPECT_EQ(map.LevelOf(fine.cell), 0u);
  EXPECT_NEAR(std::abs(map.patch(fine.cell).normal.x()), 1.0, 1e-2);
  const GaussianMap::Hit coarse = FindOne(map, {5.3, 0.2, 0.2}, 1);
  ASSERT_NE(coarse.cell, MultiResolutionMap::kNoCell);
  EXPECT_EQ(map.LevelOf(coarse.cell), 1u);
}

TEST(MultiResolutionMap, FewPointsShowASurfaceAtTheCoarseLevelAlone) {
  MultiResolutionMap map(TwoLevels());
  // The wall has 10 points a square metre: 2 or 3 in a cell of 0.5 m.
  map.Insert(Wall(5.3, 2.0, 160), kSensor);
  int num_coarse = 0;
  int num_fine = 0;
  for (const Vector3& point : Wall(5.3, 1.5, 100)) {
    const GaussianMap::Hit hit = FindOne(map, point, 0);
    if (hit.cell == MultiResolutionMap::kNoCell) continue;
    (map.LevelOf(hit.cell) == 0 ? num_fine : num_coarse) += 1;
  }
  EXPECT_GT(num_coarse, 50);
  EXPECT_LT(num_fine, 10);
}

TEST(MultiResolutionMap, NoCellIsFoundBeyondTheCoarsestLevelInUse) {
  MultiResolutionMap map(TwoLevels());
  map.Insert(Wall(5.3, 2.0, 160), kSensor);
  const Vector3 point(5.3, 0.2, 0.2);
  GaussianMap::Hit hit;
  map.FindAll({&point, 1}, {1, 1}, {&hit, 1});
  EXPECT_NE(hit.cell, MultiResolutionMap::kNoCell);
  map.FindAll({&point, 1}, {0, 0}, {&hit, 1});
  EXPECT_EQ(hit.cell, MultiResolutionMap::kNoCell);
}

TEST(MultiResolutionMap, AFinerLevelIsFilledOnlyWhereItIsInUse) {
  MultiResolutionMap map(TwoLevels(), 1);
  ASSERT_EQ(map.num_levels(), 3u);
  const Vector3 point(5.38, 0.12, 0.12);
  GaussianMap::Hit hit;
  map.Insert(Wall(5.38, 2.0, 40000), kSensor, Workers(1), 1);
  map.FindAll({&point, 1}, {0, 2}, {&hit, 1});
  EXPECT_EQ(map.LevelOf(hit.cell), 1u);
  map.Insert(Wall(5.38, 2.0, 40000), kSensor, Workers(1), 0);
  map.FindAll({&point, 1}, {0, 2}, {&hit, 1});
  EXPECT_EQ(map.LevelOf(hit.cell), 0u);
}

TEST(MultiResolutionMap, WhereNothingIsThereIsNoCell) {
  MultiResolutionMap map(TwoLevels());
  EXPECT_EQ(FindOne(map, {1, 2, 3}, 0).cell, MultiResolutionMap::kNoCell);
  map.Insert(Wall(5.3, 2.0, 1600), kSensor);
  EXPECT_EQ(FindOne(map, {15.0, 0.0, 0.0}, 0).cell, MultiResolutionMap::kNoCell);
}

TEST(MultiResolutionMap, FindingAllIsFindingEach) {
  MultiResolutionMap map(TwoLevels());
  map.Insert(Wall(5.3, 4.0, 1500), kSensor);
  const std::vector<Vector3> points = Wall(5.3, 5.0, 700);
  std::vector<GaussianMap::Hit> hits(points.size());
  map.FindAll(points, {0, map.num_levels() - 1}, hits);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const GaussianMap::Hit one = FindOne(map, points[i], 0);
    EXPECT_EQ(hits[i].cell, one.cell);
    EXPECT_EQ(hits[i].local, one.local);
  }
}

TEST(MultiResolutionMap, APostCountsAtTheCoarsestOfTheLevels) {
  NdtOptions options = TwoLevels();
  options.num_levels = 1;
  MultiResolutionMap map(options, 0, 1);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> up(0.05, 0.95);
  std::normal_distribution<double> across(0.5, 0.03);
  std::vector<Vector3> post;
  for (int i = 0; i < 60; ++i) {
    const double x = across(random);
    const double y = across(random);
    post.emplace_back(x, y, up(random));
  }
  map.SetUp(Vector3::UnitZ());
  map.Insert(post, kSensor);
  const Vector3 point(0.5, 0.5, 0.5);
  GaussianMap::Hit hit;
  map.FindAll({&point, 1}, {0, 0}, {&hit, 1});
  ASSERT_NE(hit.cell, MultiResolutionMap::kNoCell);
  EXPECT_EQ(map.LevelOf(hit.cell), 0u);
  map.FindAll({&point, 1}, {0, 1}, {&hit, 1});
  EXPECT_TRUE(hit.cell == MultiResolutionMap::kNoCell || map.LevelOf(hit.cell) == 1u);
}

TEST(MultiResolutionMap, AGuessThatIsFarOffTakesLargeCells) {
  const MultiResolutionMap map(TwoLevels());
  EXPECT_EQ(map.LevelFor(0.0), 0u);
  EXPECT_EQ(map.LevelFor(0.1), 0u);
  EXPECT_EQ(map.LevelFor(0.2), 1u);
  EXPECT_EQ(map.LevelFor(50.0), 1u) << "the coarsest level catches";
}

TEST(MultiResolutionMap, MoreThreadsMakeTheSameMap) {
  MultiResolutionMap alone(TwoLevels());
  MultiResolutionMap together(TwoLevels());
  for (int scan = 0; scan < 3; ++scan) {
    alone.Insert(Wall(5.3 + scan, 4.0, 1500), kSensor);
    together.Insert(Wall(5.3 + scan, 4.0, 1500), kSensor, Workers(3));
  }
  ASSERT_EQ(alone.num_cells(), together.num_cells());
  for (const Vector3& point : Wall(6.3, 4.0, 300)) {
    const GaussianMap::Hit a = FindOne(alone, point, 0);
    const GaussianMap::Hit b = FindOne(together, point, 0);
    ASSERT_EQ(a.cell, b.cell);
    if (a.cell != MultiResolutionMap::kNoCell) {
      EXPECT_EQ(alone.patch(a.cell).normal, together.patch(b.cell).normal);
    }
  }
}

}  // namespace
}  // namespace lio
