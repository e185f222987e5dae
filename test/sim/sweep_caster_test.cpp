// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/sweep_caster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/closed_room.hpp"

namespace lio::sim {
namespace {

using test::Still;

// One beam that is level, and ten columns a degree.
LidarSetup Level() {
  LidarSetup setup;
  setup.model.beams = {Beam{}};
  setup.model.column_period_s = 0.1 / 3600.0;
  setup.model.beam_width_horizontal_rad = 4e-3;
  setup.model.beam_width_vertical_rad = 2e-3;
  setup.model.max_range_m = 100.0;
  return setup;
}

SweepHits CastIn(const World& world, const LidarSetup& setup) {
  const Scene scene(world);
  const Trajectory trajectory = Still();
  const Rotor rotor(setup.model, {}, 1, 0.0);
  std::vector<Vector3> directions;
  for (const Beam& beam : setup.model.beams) {
    directions.emplace_back(std::cos(beam.elevation_rad), 0.0, std::sin(beam.elevation_rad));
  }
  return CastSweep({setup, directions, rotor, scene, trajectory}, rotor.ColumnsOf(0));
}

// Returns the angle between a column and straight ahead.
double AngleOf(std::size_t column) {
  const double turned = 2.0 * M_PI * static_cast<double>(column) / 3600.0;
  return std::min(turned, 2.0 * M_PI - turned);
}

// Makes a board of 2 m 10 m ahead, in front of a wall at 14 m.
World BoardBeforeWall() {
  World world;
  AddBox(world.fixed.page(), UprightPose({14.5, 0, -50}, 0.0), {1, 100, 100}, Material::kBrick);
  AddBox(world.fixed.page(), UprightPose({10.05, 0, -1}, 0.0), {0.1, 2, 2}, Material::kPlaster);
  return world;
}

TEST(SweepCaster, SubRaysFindTheEdgesOfABoardAndNothingElse) {
  LidarSetup setup = Level();
  setup.errors.has_footprint = true;
  const SweepHits sweep = CastIn(BoardBeforeWall(), setup);
  const double edge_rad = std::atan2(1.0, 10.0);
  int num_edges = 0;
  for (std::size_t column = 0; column < sweep.hits.size(); ++column) {
    if (AngleOf(column) > 0.3) continue;
    const double off_rad = std::abs(AngleOf(column) - edge_rad);
    const Rim* rim = sweep.RimOf(column);
    if (rim != nullptr) {
      EXPECT_LT(off_rad, 2e-3) << "an edge within half the beam's width";
      ++num_edges;
    } else {
      EXPECT_GT(off_rad, 1.9e-3);
    }
  }
  EXPECT_GE(num_edges, 4);
}

TEST(SweepCaster, SubRaysLookAboveAndBelow) {
  LidarSetup setup = Level();
  setup.errors.has_footprint = true;
  const double top_rad = std::atan2(1.0, 10.0);
  setup.model.beams = {Beam{top_rad - 0.01, 0, 0}, Beam{top_rad - 5e-4, 0, 0},
                       Beam{top_rad + 0.01, 0, 0}};
  const SweepHits sweep = CastIn(BoardBeforeWall(), setup);
  EXPECT_EQ(sweep.RimOf(0), nullptr);
  ASSERT_NE(sweep.RimOf(1), nullptr);
  EXPECT_EQ(sweep.RimOf(1)->is_beyond_edge, (std::array<bool, 4>{false, false, false, true}));
  EXPECT_EQ(sweep.RimOf(2), nullptr);
}

TEST(SweepCaster, WithoutTheEffectsNoFurtherRayIsCast) {
  const SweepHits sweep = CastIn(BoardBeforeWall(), Level());
  EXPECT_TRUE(sweep.rims.empty());
  EXPECT_TRUE(sweep.behinds.empty());
  EXPECT_EQ(sweep.RimOf(0), nullptr);
  EXPECT_EQ(sweep.BehindOf(0), nullptr);
}

TEST(SweepCaster, AMirrorShowsWhatIsBesideAndAWindowWhatIsBehind) {
  LidarSetup setup = Level();
  setup.errors.has_glass = true;
  World world;
  // A pane ahead that is turned by 45 degrees, a wall to the left of it and one behind it.
  AddBox(world.fixed.page(), UprightPose({10, 0, -2}, M_PI / 4), {0.001, 3, 4}, Material::kGlass);
  AddBox(world.fixed.page(), UprightPose({10, 7.5, -2}, 0.0), {4, 1, 4}, Material::kPlaster);
  AddBox(world.fixed.page(), UprightPose({10, -7.5, -2}, 0.0), {4, 1, 4}, Material::kPlaster);
  AddBox(world.fixed.page(), UprightPose({14.5, 0, -2}, 0.0), {1, 4, 4}, Material::kBrick);
  const SweepHits sweep = CastIn(world, setup);
  ASSERT_EQ(sweep.hits[0].material, Material::kGlass);
  const Behind* behind = sweep.BehindOf(0);
  ASSERT_NE(behind, nullptr);
  EXPECT_EQ(behind->mirrored.material, Material::kPlaster);
  EXPECT_NEAR(behind->mirrored.range_m, 7.0, 2e-3);
  EXPECT_EQ(behind->through.material, Material::kBrick);
  EXPECT_NEAR(behind->through.range_m + kPolish.pane_m, 4.0, 2e-3);
}

}  // namespace
}  // namespace lio::sim
