// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/scene.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "sim/mesh_checks.hpp"

namespace lio::sim {
namespace {

using test::CastOne;

World WallAndMover() {
  World world;
  AddQuad(world.fixed.page(), {10, -50, -50}, {10, 50, -50}, {10, 50, 50}, {10, -50, 50},
          Material::kBrick);
  Mesh box;
  AddBox(box, UprightPose({0, 0, -0.5}, 0.0), {1.0, 1.0, 1.0}, Material::kRetro);
  world.shapes.push_back(box);
  // The mover drives toward the sensor and brakes while it turns.
  world.movers.push_back({0, [](double t) {
                            return UprightPose({8.0 - 10.0 * t + 4.0 * t * t, 0.0, 0.0}, 0.0);
                          }});
  return world;
}

TEST(Scene, FindsTheWallItsMaterialAndIncidence) {
  const World world = WallAndMover();
  const Scene scene(world);
  const auto interval = scene.During(0.0, 0.1);
  const Hit hit = CastOne(interval, {0, 5, 0}, {1, 1, 0});
  EXPECT_EQ(hit.object, Hit::kFixed);
  EXPECT_NEAR(hit.range_m, 10.0 * std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(hit.cos_incidence, std::sqrt(0.5), 1e-5);
  EXPECT_EQ(hit.material, Material::kBrick);
}

TEST(Scene, LeavesTbbAllThreadsOfTheMachine) {
  using tbb::global_control;
  const std::size_t before = global_control::active_value(global_control::max_allowed_parallelism);
  const World world = WallAndMover();
  const Scene scene(world);
  const auto interval = scene.During(0.0, 0.1);
  EXPECT_EQ(global_control::active_value(global_control::max_allowed_parallelism), before);
}

// A row of walls with boxes that pass before it is seen in parts as it is seen whole, while the
// sensor goes along.
TEST(Scene, PartsOfALargeWorldShowWhatLiesInReach) {
  World world;
  for (int i = -20; i <= 20; ++i) {
    AddQuad(world.fixed.page(), {60.0 * i, 10, -5}, {60.0 * i + 40, 10, -5}, {60.0 * i + 40, 10, 5},
            {60.0 * i, 10, 5}, i % 2 == 0 ? Material::kBrick : Material::kGlass);
  }
  Mesh box;
  AddBox(box, UprightPose({0, 0, -1}, 0.0), {4.0, 2.0, 2.0}, Material::kCarPaint);
  world.shapes.push_back(box);
  for (int i = -9; i <= 9; ++i) {
    world.movers.push_back({0, [i](double t_s) {
                              return UprightPose({120.0 * i + 30.0 * t_s, 7.0, 0.0}, 0.0);
                            }});
  }
  const double reach_m = 100.0;
  const Scene whole(world);
  const Scene parts(world, reach_m, 10);
  int num_hits = 0;
  int num_boxes = 0;
  for (double x = -1100.0; x < 1100.0; x += 17.0) {
    const auto in_whole = whole.During(0.0, 0.1, {x, 0, 0});
    const auto in_parts = parts.During(0.0, 0.1, {x, 0, 0});
    for (double along = -6.0; along <= 6.0; along += 0.31) {
      const Vector3f from(static_cast<float>(x), 0, 0);
      const Vector3f direction(static_cast<float>(along), 1, 0);
      const Hit hit = CastOne(in_whole, from, direction);
      const Hit same = CastOne(in_parts, from, direction);
      ASSERT_EQ(hit.object, same.object) << x << " " << along;
      ASSERT_EQ(hit.material, same.material);
      ASSERT_FLOAT_EQ(hit.range_m, same.range_m);
      if (hit.object == Hit::kFixed) ++num_hits;
      if (hit.object >= 0) ++num_boxes;
    }
  }
  EXPECT_GT(num_hits, 1000);
  EXPECT_GT(num_boxes, 100);
}

TEST(Scene, NothingInReachIsNothing) {
  const World world = WallAndMover();
  const Scene scene(world);
  const Hit hit = CastOne(scene.During(0.0, 0.1), {0, 5, 0}, {-1, 0, 0});
  EXPECT_EQ(hit.object, Hit::kNothing);
  EXPECT_TRUE(std::isinf(hit.range_m));
}

TEST(Scene, MoversAreWhereTheyAreAtTheRaysOwnInstant) {
  const World world = WallAndMover();
  const Scene scene(world);
  const double begin = 0.2;
  const double end = 0.3;
  const auto interval = scene.During(begin, end);
  for (double ratio = 0.0; ratio <= 1.0; ratio += 0.03) {
    const double t = begin + ratio * (end - begin);
    const Hit hit = CastOne(interval, {0, 0, 0}, {1, 0, 0}, static_cast<float>(ratio));
    EXPECT_EQ(hit.object, 0);
    EXPECT_EQ(hit.material, Material::kRetro);
    // Motion is linear between poses 10 ms apart, which is off by a dt^2 / 8 = 0.1 mm.
    EXPECT_NEAR(hit.range_m, 8.0 - 10.0 * t + 4.0 * t * t - 0.5, 2e-4) << "at " << t;
  }
}

// A walker turns round at once. Half-way a matrix between the two poses would be singular.
TEST(Scene, AMoverThatTurnsRoundAtOnceStaysWhereItIs) {
  World world = WallAndMover();
  world.movers.front().T_world_mover = [](double t) {
    const Quaternion round(0, 0, 0, 1);
    return Pose{t < 0.05 ? Quaternion::Identity() : round, {5.0, 0.0, 0.0}};
  };
  const Scene scene(world);
  const auto interval = scene.During(0.0, 0.1);
  for (int i = 0; i <= 1000; ++i) {
    const Hit hit = CastOne(interval, {0, 0, 0}, {1, 0, 0}, static_cast<float>(0.001 * i));
    EXPECT_EQ(hit.object, 0) << i;
    EXPECT_NEAR(hit.range_m, 4.5, 0.5) << i;
  }
}

TEST(Scene, AnswersDoNotDependOnTheCompanyOfARay) {
  const World world = WallAndMover();
  const Scene scene(world);
  const auto interval = scene.During(0.0, 0.1);
  std::vector<Ray> rays;
  for (int i = 0; i < 37; ++i) {
    const Vector3f direction(1.0f, 0.02f * static_cast<float>(i - 18), 0.01f);
    rays.push_back({{0, 0, 0}, direction.normalized(), 0.027f * static_cast<float>(i)});
  }
  std::vector<Hit> together(rays.size());
  interval.Cast(rays, 100.0f, together);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Hit alone;
    interval.Cast({&rays[i], 1}, 100.0f, {&alone, 1});
    EXPECT_EQ(alone.range_m, together[i].range_m);
    EXPECT_EQ(alone.object, together[i].object);
  }
}

TEST(Scene, EmptyWorldIsAllowed) {
  const World world;
  const Scene scene(world);
  EXPECT_EQ(CastOne(scene.During(0.0, 0.1), {0, 0, 0}, {1, 0, 0}).object, Hit::kNothing);
}

}  // namespace
}  // namespace lio::sim
