// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/building.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/mesh_checks.hpp"

namespace lio::sim {
namespace {

using test::Extent;
using test::ExtentOf;
using test::StillScene;

// The storeys are 4 and 3.2 m high; the building is 12 x 10 m.
BuildingPlan PlanOf(int num_storeys, bool has_gable_roof) {
  BuildingPlan plan;
  plan.num_storeys = num_storeys;
  plan.has_gable_roof = has_gable_roof;
  return plan;
}

TEST(Building, WindowsAreRecessedIntoTheFront) {
  Random random(1, Purpose::kWorld);
  BuildingPlan plan;
  plan.facade.recess_m = 0.3;
  plan.facade.balcony_chance = 0.0;
  const Mesh house = MakeBuilding(plan, random);
  test::ExpectSound(house);
  const StillScene scene(house);
  // The rays hit the front at right angles from 20 m, along the middle of the third storey.
  int num_wall = 0;
  int num_glass = 0;
  for (double x = 0.05; x < plan.size_m.x(); x += 0.1) {
    const Hit hit = scene.Cast({x, -20.0, 4.0 + 3.2 + 1.6}, Vector3::UnitY());
    ASSERT_EQ(hit.object, Hit::kFixed);
    const double depth = hit.range_m - 20.0;
    if (hit.material == Material::kGlass) {
      EXPECT_NEAR(depth, 0.3, 1e-3);
      ++num_glass;
    } else if (std::abs(depth) < 1e-3) {
      ++num_wall;
    }
  }
  EXPECT_GT(num_glass, 30);
  EXPECT_GT(num_wall, 30);
}

TEST(Building, HasNoHolesSeenFromAround) {
  Random random(3, Purpose::kWorld);
  for (const bool gable : {false, true}) {
    BuildingPlan plan = PlanOf(3, gable);
    plan.has_plain_rear = false;
    const StillScene scene(MakeBuilding(plan, random));
    const Vector3 middle(0.5 * plan.size_m.x(), 0.5 * plan.size_m.y(), 4.0);
    for (int i = 0; i < 2000; ++i) {
      const double angle = random.Uniform(0.0, 6.283);
      const Vector3 from = middle + Vector3(40.0 * std::cos(angle), 40.0 * std::sin(angle),
                                            random.Uniform(-4.0, 20.0));
      ASSERT_LT(scene.Cast(from, middle - from).range_m, (middle - from).norm())
          << "a ray reached the inside";
    }
  }
}

// Four storeys are 4 + 3 * 3.2 m high; a parapet of 0.9 m or a stair head of 2.5 m is on top.
TEST(Building, FlatRoofsLieOnTheStoreys) {
  Random random(2, Purpose::kWorld);
  const Mesh house = MakeBuilding(PlanOf(4, false), random);
  const StillScene scene(house);
  double height_m = 0.0;
  scene.Down({0.6, 0.6}, height_m);
  EXPECT_NEAR(height_m, 13.6, 1e-3);
  scene.Down({0.1, 5.0}, height_m);
  EXPECT_NEAR(height_m, 14.5, 0.01) << "the parapet";
  EXPECT_NEAR(ExtentOf(house).high.z(), 16.1, 0.01) << "the stair head";
}

TEST(Building, GableRoofsHaveTheirRidgeAlongTheFront) {
  Random random(2, Purpose::kWorld);
  const BuildingPlan plan = PlanOf(2, true);
  const StillScene scene(MakeBuilding(plan, random));
  const double eave_m = 4.0 + 3.2;
  const double ridge_m = eave_m + 0.42 * plan.size_m.y();
  for (const double x : {1.0, 11.0}) {
    double ridge = 0.0, front = 0.0, rear = 0.0;
    EXPECT_EQ(scene.Down({x, 5.0}, ridge).material, Material::kRoofTile);
    scene.Down({x, 2.0}, front);
    scene.Down({x, 8.0}, rear);
    EXPECT_NEAR(ridge, ridge_m, 0.01);
    EXPECT_NEAR(front, rear, 0.01);
    // The roof is straight between eave and ridge, except for the overhang.
    EXPECT_NEAR(front, eave_m + 0.4 * (ridge_m - eave_m), 0.05);
  }
}

TEST(Building, WallsReachIntoASlope) {
  Random random(2, Purpose::kWorld);
  const Mesh house = MakeBuilding(PlanOf(2, false), random);
  EXPECT_NEAR(ExtentOf(house).low.z(), -3.0, 1e-5);
  const StillScene scene(house);
  for (const Vector3& from : {Vector3(6, -20, -2.5), Vector3(6, 30, -2.5)}) {
    const Vector3 ahead(0, from.y() < 0 ? 1 : -1, 0);
    EXPECT_NEAR(scene.Cast(from, ahead).range_m, 20.0, 1e-3);
  }
}

TEST(Building, APlainRearIsAWallAndNoMore) {
  Random random(2, Purpose::kWorld);
  BuildingPlan plan = PlanOf(3, false);
  const auto num_glass_behind = [&] {
    const StillScene scene(MakeBuilding(plan, random));
    int num = 0;
    for (double x = 0.2; x < 12.0; x += 0.2) {
      num += scene.Cast({x, 30.0, 5.7}, -Vector3::UnitY()).material == Material::kGlass;
    }
    return num;
  };
  EXPECT_EQ(num_glass_behind(), 0);
  plan.has_plain_rear = false;
  EXPECT_GT(num_glass_behind(), 10);
}

TEST(Building, BalconiesStandOutOfTheFront) {
  Random random(2, Purpose::kWorld);
  BuildingPlan plan = PlanOf(3, false);
  plan.facade.has_shops = false;
  plan.facade.balcony_chance = 0.0;
  EXPECT_GT(ExtentOf(MakeBuilding(plan, random)).low.y(), -0.5f);
  plan.facade.balcony_chance = 1.0;
  EXPECT_NEAR(ExtentOf(MakeBuilding(plan, random)).low.y(), -1.1, 1e-5);
}

TEST(Building, FacadesAreDrawnWithinWhatIsBuilt) {
  Random random(9, Purpose::kWorld);
  int num_with_shops = 0;
  for (int i = 0; i < 200; ++i) {
    const FacadeStyle style = RandomFacade(random);
    EXPECT_LT(style.window_width_m, 0.66 * style.bay_m);
    EXPECT_LT(style.sill_m + style.window_height_m, style.storey_m);
    EXPECT_GE(style.recess_m, 0.08);
    EXPECT_LE(style.balcony_chance, 0.7);
    num_with_shops += style.has_shops;
  }
  EXPECT_NEAR(num_with_shops, 120, 30);  // a share of 0.6 with 4 sigma
}

TEST(Building, OneSeedBuildsOneHouse) {
  Random a(5, Purpose::kWorld), b(5, Purpose::kWorld), c(6, Purpose::kWorld);
  const Mesh house = MakeBuilding(PlanOf(3, false), a);
  EXPECT_EQ(house.vertices_m, MakeBuilding(PlanOf(3, false), b).vertices_m);
  EXPECT_NE(house.vertices_m, MakeBuilding(PlanOf(3, false), c).vertices_m);
}

}  // namespace
}  // namespace lio::sim
