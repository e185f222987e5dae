// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/movers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/mover_speed.hpp"

namespace lio::sim {
namespace {

using test::SpeedOf;

// The nose points up where the ground rises by a tenth.
TEST(Movers, VehiclesFollowTheirPathOnTheGround) {
  World world;
  Random random(1, Purpose::kTraffic);
  Path road({0, 0}, 0.0);
  road.AddStraight(200.0);
  AddVehicleMover(
      world, VehicleKind::kCar, random, road, [](double t_s) { return 20.0 + 10.0 * t_s; },
      [](const Vector2& p, double) { return 0.1 * p.x(); });
  ASSERT_EQ(world.movers.size(), 1u);
  const Pose pose = world.movers[0].T_world_mover(3.0);
  EXPECT_LT((pose.translation - Vector3(50.0, 0.0, 5.0)).norm(), 1e-9);
  const Vector3 ahead = pose.rotation * Vector3::UnitX();
  EXPECT_NEAR(ahead.z() / ahead.x(), 0.1, 1e-9);
  EXPECT_NEAR(SpeedOf(world.movers[0], 3.0), 10.0 * std::hypot(1.0, 0.1), 1e-6);
}

TEST(Movers, LegsSwingAgainstEachOtherAboutTheHip) {
  World world;
  Random random(1, Purpose::kTraffic);
  AddWalker(world, random, 1.5, [](double) { return UprightPose({5, 6, 0}, 0.0); });
  ASSERT_EQ(world.movers.size(), 3u);
  double widest = 0.0;
  for (double t_s = 0.0; t_s < 1.0; t_s += 0.05) {
    const Pose right = world.movers[1].T_world_mover(t_s);
    const Pose left = world.movers[2].T_world_mover(t_s);
    EXPECT_LT((right.translation - Vector3(5, 5.9, kHipHeight_m)).norm(), 1e-9);
    EXPECT_LT((left.translation - Vector3(5, 6.1, kHipHeight_m)).norm(), 1e-9);
    const double swing = LogSo3(left.rotation).y();
    EXPECT_NEAR(LogSo3(right.rotation).y(), -swing, 1e-9);
    widest = std::max(widest, std::abs(swing));
  }
  EXPECT_NEAR(widest, 0.45, 0.03);
}

}  // namespace
}  // namespace lio::sim
