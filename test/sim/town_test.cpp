// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/town.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sim/mesh_checks.hpp"
#include "sim/mover_speed.hpp"

namespace lio::sim {
namespace {

using test::SpeedOf;
using test::StillScene;

// The town has a straight road of 200 m along x, 8 m wide, on flat ground.
class TownTest : public ::testing::Test {
 protected:
  static Terrain Flat() {
    Random random(1, Purpose::kWorld);
    return Terrain({{0, 0}, 0.0, 0.0}, random);
  }
  static Path Road() {
    Path path({0, 0}, 0.0);
    path.AddStraight(200.0);
    return path;
  }
  static Frontage Beside(double offset_m, bool on_left = true) {
    return {10.0, 190.0, offset_m, on_left};
  }
  // Returns the share of places along y where a ray from above meets something that `wanted`
  // accepts.
  double ShareOver(double y, const std::function<bool(const Hit&, double height_m)>& wanted) const {
    const StillScene scene(world_.fixed.Whole());
    int num = 0, num_wanted = 0;
    for (double x = 10.0; x < 190.0; x += 0.13, ++num) {
      double height_m = 0.0;
      const Hit hit = scene.Down({x, y}, height_m);
      num_wanted += wanted(hit, height_m);
    }
    return static_cast<double>(num_wanted) / num;
  }
  double ShareOf(double y, Material material) const {
    return ShareOver(y, [=](const Hit& hit, double) { return hit.material == material; });
  }
  double ShareAbove(double y, double least_m) const {
    return ShareOver(y, [=](const Hit&, double height_m) { return height_m > least_m; });
  }

  World world_;
  Path road_ = Road();
  Town town_{world_, Flat(), RoadNetwork({{{{0, 0}, {200, 0}}, 4.0}}), {}, 5};
};

// --- places

TEST_F(TownTest, ReservesNoPlaceTwiceAndNoneOnRoads) {
  EXPECT_TRUE(town_.Reserve({40.0, 12.0}, 0.3, {10.0, 6.0}, 1.0));
  EXPECT_FALSE(town_.Reserve({42.0, 13.0}, 0.9, {6.0, 6.0}, 1.0));
  EXPECT_TRUE(town_.Reserve({60.0, 12.0}, 0.3, {10.0, 6.0}, 1.0));
  EXPECT_FALSE(town_.Reserve({20.0, 6.0}, 0.0, {4.0, 4.0}, 1.0));
}

// The bounding boxes of the two rectangles overlap, but the rectangles do not.
TEST_F(TownTest, TurnedRectanglesAreComparedAsTheyLie) {
  EXPECT_TRUE(town_.Reserve({50.0, 30.0}, M_PI / 4, {20.0, 1.0}, 1.0));
  EXPECT_TRUE(town_.Reserve({55.0, 25.0}, M_PI / 4, {20.0, 1.0}, 1.0));
  EXPECT_FALSE(town_.Reserve({55.0, 35.0}, -M_PI / 4, {20.0, 1.0}, 1.0)) << "they cross";
}

TEST_F(TownTest, ALaneThatIsKeptClearStaysFree) {
  Path lane({0, 20}, 0.0);
  lane.AddStraight(100.0);
  town_.KeepClear(lane, 3.0);
  EXPECT_FALSE(town_.Reserve({50.0, 21.0}, 0.0, {1.0, 1.0}, 0.0));
  EXPECT_TRUE(town_.Reserve({50.0, 22.5}, 0.0, {1.0, 1.0}, 0.0));
  EXPECT_TRUE(town_.Reserve({150.0, 20.0}, 0.0, {1.0, 1.0}, 0.0)) << "beyond its end";
}

TEST_F(TownTest, GroundIsAKerbHigherBesideTheRoad) {
  EXPECT_EQ(town_.GroundHeight({50.0, 0.0}), 0.0);
  EXPECT_EQ(town_.GroundHeight({50.0, 6.0}), GroundOptions{}.kerb_m);
}

TEST_F(TownTest, ThingsArePutOnTheGroundAsTheyHead) {
  Mesh box;
  AddBox(box, UprightPose({2.0, 0.0, 0.0}, 0.0), {1.0, 1.0, 2.0}, Material::kRetro);
  town_.Place(box, {50.0, 10.0}, 0.5 * M_PI);  // its x goes along y
  const StillScene scene(world_.fixed.Whole());
  double height_m = 0.0;
  EXPECT_EQ(scene.Down({50.0, 12.0}, height_m).material, Material::kRetro);
  EXPECT_NEAR(height_m, GroundOptions{}.kerb_m + 2.0, 1e-4);
}

// --- rows of things

TEST_F(TownTest, HousesStandInARowAndFaceTheRoad) {
  HouseRow row;
  row.gap_chance = 0.0;
  row.max_setback_m = 0.0;
  town_.AddHouses(road_, Beside(10.0), row);
  EXPECT_GT(ShareAbove(14.0, 8.0), 0.9);
  EXPECT_LT(ShareAbove(6.0, 2.0), 0.01) << "nothing stands on the pavement";
  // Fronts have windows; rears have none.
  const StillScene scene(world_.fixed.Whole());
  int num_front = 0, num_rear = 0;
  for (double x = 15.0; x < 185.0; x += 0.5) {
    num_front += scene.Cast({x, 0.0, 6.0}, Vector3::UnitY()).material == Material::kGlass;
    num_rear += scene.Cast({x, 50.0, 6.0}, -Vector3::UnitY()).material == Material::kGlass;
  }
  EXPECT_GT(num_front, 60);
  EXPECT_EQ(num_rear, 0);
}

TEST_F(TownTest, NothingIsBuiltWhereSomethingStands) {
  ASSERT_TRUE(town_.Reserve({100.0, 15.0}, 0.0, {180.0, 10.0}, 1.0));
  const std::size_t before = world_.fixed.num_triangles();
  town_.AddHouses(road_, Beside(10.0), {});
  town_.AddTrees(road_, Beside(12.0), 5.0, 6.0);
  town_.AddLamps(road_, Beside(12.0), 5.0);
  town_.AddHedges(road_, Beside(12.0), 1.0);
  town_.AddStreetThings(road_, Beside(12.0), 5.0);
  town_.AddStandingPeople(road_, Beside(12.0), 10);
  EXPECT_EQ(world_.fixed.num_triangles(), before);
}

TEST_F(TownTest, LampsStandAtTheirSpacingAndLeanOverTheRoad) {
  town_.AddLamps(road_, {10.0, 61.0, 5.0, true}, 10.0);
  const StillScene scene(world_.fixed.Whole());
  for (double x = 10.0; x < 61.0; x += 10.0) {
    double height_m = 0.0;
    EXPECT_EQ(scene.Down({x, 5.0 - 1.6}, height_m).material, Material::kDarkMetal) << x;
    EXPECT_GT(height_m, 7.0);
  }
  double height_m = 0.0;
  EXPECT_EQ(scene.Down({15.0, 3.4}, height_m).material, Material::kAsphalt);
}

TEST_F(TownTest, CarsParkByTheKerbOnly) {
  town_.AddParkedCars(road_, Beside(2.9), 1.0);
  EXPECT_GT(ShareAbove(2.9, 0.4), 0.6);
  EXPECT_LT(ShareAbove(0.5, 0.1), 1e-9) << "the lane is free";
  const std::size_t before = world_.fixed.num_triangles();
  town_.AddParkedCars(road_, Beside(0.0), 1.0);
  town_.AddParkedCars(road_, Beside(8.0), 1.0);
  EXPECT_EQ(world_.fixed.num_triangles(), before) << "neither in the middle nor off the road";
}

TEST_F(TownTest, TheShareOfParkedCarsIsKept) {
  town_.AddParkedCars(road_, Beside(2.9, false), 0.0);
  EXPECT_EQ(ShareAbove(-2.9, 0.4), 0.0);
}

TEST_F(TownTest, HedgesAreAsHighAsHedges) {
  town_.AddHedges(road_, Beside(9.0), 1.0);
  EXPECT_GT(ShareOf(9.0, Material::kFoliage), 0.5);
  EXPECT_EQ(ShareAbove(9.0, 2.0), 0.0);
  EXPECT_EQ(ShareOf(7.0, Material::kFoliage), 0.0);
}

TEST_F(TownTest, BarriersRunThroughBetweenTheirHeights) {
  town_.AddBarrier(road_, Beside(6.0), 4.0, 0.5, 0.8, Material::kMetal);
  const double ground_m = GroundOptions{}.kerb_m;
  const StillScene scene(world_.fixed.Whole());
  for (double x = 11.0; x < 189.0; x += 1.7) {
    const Hit hit = scene.Cast({x, 0.0, ground_m + 0.65}, Vector3::UnitY());
    EXPECT_NEAR(hit.range_m, 5.95, 0.02) << x;
  }
  // The ray passes below the rail between two posts.
  EXPECT_GT(scene.Cast({12.0, 0.0, ground_m + 0.3}, Vector3::UnitY()).range_m, 20.0);
}

TEST_F(TownTest, LaneMarksAreDashesOnTheRoad) {
  town_.AddLaneMarks(road_, Beside(0.0), 3.0, 6.0);
  EXPECT_NEAR(ShareOf(0.0, Material::kMarking), 1.0 / 3.0, 0.03);
  EXPECT_EQ(ShareOf(0.2, Material::kMarking), 0.0);
  town_.AddLaneMarks(road_, Beside(3.5), 3.0, 0.0);
  EXPECT_GT(ShareOf(3.5, Material::kMarking), 0.97) << "without gaps it is a line";
}

TEST_F(TownTest, OneSeedMakesOneTown) {
  const auto build = [](std::uint64_t seed) {
    World world;
    Town town(world, Flat(), RoadNetwork({{{{0, 0}, {200, 0}}, 4.0}}), {}, seed);
    town.AddHouses(Road(), Beside(10.0), {});
    town.AddTrees(Road(), Beside(6.0), 8.0, 6.0);
    return world.fixed.Whole().vertices_m;
  };
  EXPECT_EQ(build(3), build(3));
  EXPECT_NE(build(3), build(4));
}

// --- what moves

TEST_F(TownTest, WalkersKeepToTheirWayAndWalk) {
  town_.AddWalkers(road_, Beside(6.0, false), 5);
  ASSERT_EQ(world_.movers.size(), 15u);  // a torso and two legs each
  for (std::size_t i = 0; i < world_.movers.size(); i += 3) {
    int num_turns = 0;
    for (double t_s = 0.0; t_s < 60.0; t_s += 0.5) {
      const Pose pose = world_.movers[i].T_world_mover(t_s);
      EXPECT_NEAR(pose.translation.y(), -6.0, 0.51);
      EXPECT_NEAR(pose.translation.z(), GroundOptions{}.kerb_m, 1e-12);
      const double speed = SpeedOf(world_.movers[i], t_s);
      if (speed < 0.9 - 1e-6) ++num_turns;
      EXPECT_LT(speed, 1.6 + 1e-6);
    }
    EXPECT_LT(num_turns, 3) << "they only turn at their ends";
  }
}

}  // namespace
}  // namespace lio::sim
