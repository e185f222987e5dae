// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/mesh_checks.hpp"

namespace lio::sim {
namespace {

using test::StillScene;

// --- terrain

TEST(Terrain, WithoutWavesIsTheSlope) {
  Random random(5, Purpose::kWorld);
  const Terrain terrain({{0.02, -0.01}, 0.0, 0.0}, random);
  EXPECT_DOUBLE_EQ(terrain.Height({0, 0}), 0.0);
  EXPECT_NEAR(terrain.Height({100, 50}), 2.0 - 0.5, 1e-12);
}

// The height has four waves of at most hill / 2 each and five of at most bump / sqrt(5).
TEST(Terrain, HillsAndBumpsKeepToTheirHeights) {
  Random random(5, Purpose::kWorld);
  const Terrain terrain({{0, 0}, 0.8, 0.02}, random);
  const double limit_m = 2.0 * 0.8 + std::sqrt(5.0) * 0.02;
  double highest = -1e9, lowest = 1e9, steepest = 0.0;
  for (double x = -300; x < 300; x += 7.3) {
    for (double y = -300; y < 300; y += 7.3) {
      const double height = terrain.Height({x, y});
      highest = std::max(highest, height);
      lowest = std::min(lowest, height);
      steepest = std::max(steepest, std::abs(terrain.Height({x + 0.1, y}) - height) / 0.1);
    }
  }
  EXPECT_LT(std::max(highest, -lowest), limit_m);
  EXPECT_GT(highest - lowest, 0.8) << "there are hills";
  EXPECT_LT(steepest, 2.0 * M_PI * (1.6 / 60.0 + 0.045 / 5.0));
}

// --- roads

TEST(RoadNetwork, DistanceIsThatToTheEdge) {
  const RoadNetwork network({{{{0, 0}, {80, 0}}, 4.0}});
  EXPECT_NEAR(network.SignedDistance({40, 9}), 5.0, 1e-9);
  EXPECT_NEAR(network.SignedDistance({40, -9}), 5.0, 1e-9);
  EXPECT_NEAR(network.SignedDistance({40, 0}), -4.0, 1e-9);
  EXPECT_NEAR(network.SignedDistance({83, 4}), 5.0 - 4.0,
              1e-9);  // 3 and 4 m from the road's end: 5 m
}

TEST(RoadNetwork, RoundsTheCornersOfCrossings) {
  const RoadNetwork network({{{{-50, 0}, {50, 0}}, 4.0}, {{{0, -50}, {0, 50}}, 4.0}}, 6.0);
  EXPECT_NEAR(network.SignedDistance({30.0, 9.0}), 5.0, 1e-9);
  EXPECT_LT(network.SignedDistance({4.5, 4.5}), 0.0);  // outside both, inside the rounding
  // At equal distance from both roads the smooth minimum is a quarter of the rounding lower: 0.5 -
  // 1.5.
  EXPECT_NEAR(network.SignedDistance({4.5, 4.5}), -1.0, 1e-9);
}

// A road of many pieces has the distance that its segments have alone.
TEST(RoadNetwork, PiecesOfALongRoadHideNoNearerSegment) {
  Random random(6, Purpose::kWorld);
  Road road{{{0, 0}}, 4.0};
  std::vector<Road> segments;
  for (int i = 0; i < 100; ++i) {
    const Vector2 from = road.line_m.back();
    road.line_m.emplace_back(from + Vector2{random.Uniform(-9, 12), random.Uniform(-9, 12)});
    segments.push_back({{from, road.line_m.back()}, 4.0});
  }
  const RoadNetwork whole({road});
  for (int i = 0; i < 500; ++i) {
    const Vector2 p = {random.Uniform(-100, 250), random.Uniform(-100, 250)};
    double nearest_m = 1e9;
    for (const Road& segment : segments) {
      nearest_m = std::min(nearest_m, RoadNetwork({segment}).SignedDistance(p));
    }
    EXPECT_NEAR(whole.SignedDistance(p), nearest_m, 1e-9);
  }
}

// --- the mesh of a crossing

class GroundTest : public ::testing::Test {
 protected:
  StillScene Build(const GroundOptions& options) const {
    PagedMesh mesh;
    AddGround(mesh, terrain_, network_, options);
    return StillScene(mesh.Whole());
  }
  Random random_{5, Purpose::kWorld};
  Terrain terrain_{{{0.02, -0.01}, 0.8, 0.01}, random_};
  RoadNetwork network_{{{{{0, 0}, {80, 0}}, 4.0}, {{{40, -40}, {40, 40}}, 4.0}}};
  GroundOptions options_;
};

TEST_F(GroundTest, FollowsTheTerrainWithKerbsBesideTheRoad) {
  const StillScene scene = Build(options_);
  for (int i = 0; i < 3000; ++i) {
    const Vector2 p = {random_.Uniform(2.0, 78.0), random_.Uniform(-30.0, 30.0)};
    const double distance = network_.SignedDistance(p);
    double height_m = 0.0;
    const Hit hit = scene.Down(p, height_m);
    ASSERT_NE(hit.object, Hit::kNothing) << "hole in the ground at " << p.transpose();
    if (std::abs(distance) < 0.3) continue;  // the edge itself is cut straight within a cell
    const double expected = terrain_.Height(p) + (distance > 0.0 ? options_.kerb_m : 0.0);
    EXPECT_NEAR(height_m, expected, 0.02) << p.transpose();
    EXPECT_EQ(hit.material == Material::kAsphalt, distance < 0.0);
  }
}

TEST_F(GroundTest, PavingIsBesideTheRoadAndGrassBeyond) {
  const StillScene scene = Build(options_);
  double height_m = 0.0;
  EXPECT_EQ(scene.Down({15, 6}, height_m).material, Material::kPaving);
  EXPECT_EQ(scene.Down({15, -6}, height_m).material, Material::kPaving);
  EXPECT_EQ(scene.Down({15, 10}, height_m).material, Material::kGrass);
}

// A low ray over the road hits the side of the kerb: concrete, at the distance of the road's edge.
TEST_F(GroundTest, TheKerbIsAStepThatIsSeenFromTheRoad) {
  const StillScene scene = Build(options_);
  const double height_m = terrain_.Height({15, 4}) + 0.06;
  const Hit hit = scene.Cast({15, 3.5, height_m}, Vector3::UnitY());
  EXPECT_EQ(hit.material, Material::kConcrete);
  EXPECT_NEAR(hit.range_m, 0.5, 0.02);
}

TEST_F(GroundTest, WithoutAKerbRoadAndVergeAreLevel) {
  options_.kerb_m = 0.0;
  const StillScene scene = Build(options_);
  double road_m = 0.0, verge_m = 0.0;
  scene.Down({15, 3.7}, road_m);
  scene.Down({15, 4.3}, verge_m);
  EXPECT_NEAR(road_m, terrain_.Height({15, 3.7}), 0.01);
  EXPECT_NEAR(verge_m, terrain_.Height({15, 4.3}), 0.01);
}

TEST_F(GroundTest, ACoarseMeshGoesOnAndEndsWhereAskedTo) {
  options_.kerb_m = 0.0;
  const StillScene scene = Build(options_);
  double height_m = 0.0;
  const Vector2 far(20, 100);
  EXPECT_EQ(scene.Down(far, height_m).material, Material::kGrass);
  EXPECT_NEAR(height_m, terrain_.Height(far) - 0.06, 0.15);
  EXPECT_EQ(scene.Down({20, 180}, height_m).object, Hit::kNothing);
  options_.far_reach_m = options_.reach_m;
  EXPECT_EQ(Build(options_).Down(far, height_m).object, Hit::kNothing);
}

}  // namespace
}  // namespace lio::sim
