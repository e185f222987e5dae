// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Solids, props, houses and the ground: that they are where they should be and whole.
#include <gtest/gtest.h>

#include <algorithm>

#include "lio/sim/building.hpp"
#include "lio/sim/ground.hpp"
#include "lio/sim/props.hpp"
#include "lio/sim/scene.hpp"
#include "lio/sim/town.hpp"

namespace lio::sim {
namespace {

struct Extent {
  Vector3f low = Vector3f::Constant(1e9f);
  Vector3f high = Vector3f::Constant(-1e9f);
};

Extent ExtentOf(const Mesh& mesh) {
  Extent extent;
  for (const Vector3f& p : mesh.vertices_m) {
    extent.low = extent.low.cwiseMin(p);
    extent.high = extent.high.cwiseMax(p);
  }
  return extent;
}

void ExpectSound(const Mesh& mesh) {
  ASSERT_FALSE(mesh.triangles.empty());
  ASSERT_EQ(mesh.triangles.size(), mesh.materials.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t i : triangle) ASSERT_LT(i, mesh.vertices_m.size());
  }
  for (const Vector3f& p : mesh.vertices_m) ASSERT_TRUE(p.allFinite());
}

TEST(Mesh, BoxHasItsSizeAndStandsOnItsOrigin) {
  Mesh mesh;
  AddBox(mesh, UprightPose({1.0, 2.0, 3.0}, 0.0), {2.0, 4.0, 6.0}, Material::kMetal);
  ExpectSound(mesh);
  const Extent extent = ExtentOf(mesh);
  EXPECT_TRUE(extent.low.isApprox(Vector3f(0.0f, 0.0f, 3.0f)));
  EXPECT_TRUE(extent.high.isApprox(Vector3f(2.0f, 4.0f, 9.0f)));
}

TEST(Mesh, EveryMaterialHasAName) {
  for (int i = 0; i < kNumMaterials; ++i) {
    const MaterialTraits& traits = TraitsOf(static_cast<Material>(i));
    EXPECT_FALSE(traits.name.empty()) << i;
    EXPECT_GT(traits.reflectivity, 0.0) << traits.name;
  }
}

TEST(Props, VehiclesFitTheirFootprint) {
  Random random(1, Purpose::kWorld);
  for (const VehicleKind kind :
       {VehicleKind::kCar, VehicleKind::kVan, VehicleKind::kBus, VehicleKind::kTruck}) {
    for (int i = 0; i < 5; ++i) {
      const Mesh mesh = MakeVehicle(kind, random);
      ExpectSound(mesh);
      const Extent extent = ExtentOf(mesh);
      const Vector2 size = VehicleSize(kind);
      EXPECT_LE(extent.high.x() - extent.low.x(), size.x() + 0.7);
      EXPECT_LE(extent.high.y() - extent.low.y(), size.y() + 0.6);  // mirrors
      EXPECT_GE(extent.low.z(), -0.01f);
      EXPECT_GT(extent.high.z(), 1.3f);
    }
  }
}

TEST(Props, PeopleAreAsTallAsPeople) {
  Random random(1, Purpose::kWorld);
  for (int i = 0; i < 20; ++i) {
    const Extent extent = ExtentOf(MakePerson(random));
    EXPECT_NEAR(extent.low.z(), 0.0, 0.05);
    EXPECT_GT(extent.high.z(), 1.6f);
    EXPECT_LT(extent.high.z(), 1.95f);
  }
}

TEST(Props, TreesAndStreetThingsAreSound) {
  Random random(1, Purpose::kWorld);
  for (const Mesh& mesh : {MakeTree(8.0, random), MakeBush({2.0, 1.0, 1.0}, random),
                           MakeStreetLamp(8.0, 1.5), MakeSign(2.5, random), MakeBollard(),
                           MakeBin(), MakeBench(), MakeBusShelter(), MakeLeg()}) {
    ExpectSound(mesh);
  }
}

TEST(Building, WindowsAreRecessedIntoTheFront) {
  Random random(1, Purpose::kWorld);
  BuildingPlan plan;
  plan.facade.recess_m = 0.3;
  plan.facade.balcony_chance = 0.0;
  World world;
  world.fixed = MakeBuilding(plan, random);
  ExpectSound(world.fixed);
  const Scene scene(world);
  const auto interval = scene.During(0.0, 0.1);
  // Along the third storey's middle, straight at the front from 20 m.
  int num_wall = 0;
  int num_glass = 0;
  for (double x = 0.05; x < plan.size_m.x(); x += 0.1) {
    const Ray ray{{static_cast<float>(x), -20.0f, 4.0f + 3.2f + 1.6f}, {0.0f, 1.0f, 0.0f}, 0.0f};
    Hit hit;
    interval.Cast({&ray, 1}, 100.0f, {&hit, 1});
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
    BuildingPlan plan;
    plan.has_gable_roof = gable;
    plan.has_plain_rear = false;
    plan.num_storeys = 3;
    World world;
    world.fixed = MakeBuilding(plan, random);
    const Scene scene(world);
    const auto interval = scene.During(0.0, 0.1);
    const Vector3 middle(0.5 * plan.size_m.x(), 0.5 * plan.size_m.y(), 4.0);
    for (int i = 0; i < 2000; ++i) {
      const double angle = random.Uniform(0.0, 6.283);
      const Vector3 from = middle + Vector3(40.0 * std::cos(angle), 40.0 * std::sin(angle),
                                            random.Uniform(-4.0, 20.0));
      const Vector3 d = (middle - from).normalized();
      const Ray ray{from.cast<float>(), d.cast<float>(), 0.0f};
      Hit hit;
      interval.Cast({&ray, 1}, 100.0f, {&hit, 1});
      ASSERT_LT(hit.range_m, (middle - from).norm()) << "a ray reached the inside";
    }
  }
}

class GroundTest : public ::testing::Test {
 protected:
  GroundTest() : random_(5, Purpose::kWorld), terrain_({{0.02, -0.01}, 0.8, 0.01}, random_) {
    AddGround(world_.fixed, terrain_, network_, options_);
  }
  Random random_;
  Terrain terrain_;
  RoadNetwork network_{{{{{0, 0}, {80, 0}}, 4.0}, {{{40, -40}, {40, 40}}, 4.0}}};
  GroundOptions options_;
  World world_;
};

TEST_F(GroundTest, FollowsTheTerrainWithKerbsBesideTheRoad) {
  const Scene scene(world_);
  const auto interval = scene.During(0.0, 0.1);
  for (int i = 0; i < 3000; ++i) {
    const Vector2 p(random_.Uniform(2.0, 78.0), random_.Uniform(-30.0, 30.0));
    const double distance = network_.SignedDistance(p);
    const Ray ray{Vector3f(static_cast<float>(p.x()), static_cast<float>(p.y()), 50.0f),
                  {0.0f, 0.0f, -1.0f},
                  0.0f};
    Hit hit;
    interval.Cast({&ray, 1}, 200.0f, {&hit, 1});
    ASSERT_NE(hit.object, Hit::kNothing) << "hole in the ground at " << p.transpose();
    if (std::abs(distance) < 0.3) continue;  // the edge itself is cut straight within a cell
    const double expected = terrain_.Height(p) + (distance > 0.0 ? options_.kerb_m : 0.0);
    EXPECT_NEAR(50.0 - hit.range_m, expected, 0.02) << p.transpose();
    EXPECT_EQ(hit.material == Material::kAsphalt, distance < 0.0);
  }
}

TEST(RoadNetwork, RoundsTheCornersOfCrossings) {
  const RoadNetwork network({{{{-50, 0}, {50, 0}}, 4.0}, {{{0, -50}, {0, 50}}, 4.0}}, 6.0);
  EXPECT_NEAR(network.SignedDistance({30.0, 9.0}), 5.0, 1e-9);
  EXPECT_LT(network.SignedDistance({4.5, 4.5}), 0.0);  // outside both, inside the rounding
}

TEST(Town, ReservesNoPlaceTwiceAndNoneOnRoads) {
  World world;
  Random random(5, Purpose::kWorld);
  Town town(world, Terrain({}, random), RoadNetwork({{{{0, 0}, {80, 0}}, 4.0}}), {}, 5);
  EXPECT_TRUE(town.Reserve({40.0, 12.0}, 0.3, {10.0, 6.0}, 1.0));
  EXPECT_FALSE(town.Reserve({42.0, 13.0}, 0.9, {6.0, 6.0}, 1.0));
  EXPECT_TRUE(town.Reserve({60.0, 12.0}, 0.3, {10.0, 6.0}, 1.0));
  EXPECT_FALSE(town.Reserve({20.0, 6.0}, 0.0, {4.0, 4.0}, 1.0));
}

}  // namespace
}  // namespace lio::sim
