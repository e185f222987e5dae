// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Measures the office: its corridors, slabs, stairs and doors by rays, and the walk through it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lio/sim/scenario.hpp"
#include "lio/sim/scene.hpp"

namespace lio::sim {
namespace {

constexpr double kStorey_m = 3.3;

class Office : public ::testing::Test {
 protected:
  // Casts one ray at a time of the log; 99 where it meets nothing up to there.
  double RangeAt(double t_s, const Vector3& from, const Vector3& direction) const {
    const auto interval = scene_.During(t_s - 0.01, t_s + 0.01);
    const Ray ray{from.cast<float>(), direction.normalized().cast<float>(), 0.5f};
    Hit hit;
    interval.Cast({&ray, 1}, 99.0f, {&hit, 1});
    return hit.object == Hit::kNothing ? 99.0 : double{hit.range_m};
  }
  double Range(const Vector3& from, const Vector3& direction) const {
    return RangeAt(0.0, from, direction);
  }
  Vector3 GroundAt(double t_s) const { return scenario_.trajectory->BodyPoseAt(t_s).translation; }

  const Scenario scenario_ = MakeScenario("office", {});
  const Scene scene_{scenario_.world};
};

TEST_F(Office, TheWalkClimbsTwoStoreysAndEndsWhereItBegan) {
  double length_m = 0.0;
  double highest_m = 0.0;
  for (double t = 0.05; t < scenario_.duration_s; t += 0.05) {
    length_m += (GroundAt(t) - GroundAt(t - 0.05)).norm();
    highest_m = std::max(highest_m, GroundAt(t).z());
  }
  EXPECT_GT(length_m, 75.0);
  EXPECT_LT(length_m, 95.0);
  EXPECT_NEAR(highest_m, 2.0 * kStorey_m, 0.06);
  EXPECT_LT((GroundAt(scenario_.duration_s) - GroundAt(0.0)).norm(), 1e-3);
}

TEST_F(Office, TheSensorIsTurnedLikeAHead) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    ScenarioOptions options;
    options.seed = seed;
    const Scenario scenario = MakeScenario("office", options);
    double fastest_radps = 0.0;
    for (double t = 0.0; t < scenario.duration_s; t += 0.02) {
      fastest_radps = std::max(fastest_radps, scenario.trajectory->At(t).w_imu_radps.norm());
    }
    EXPECT_GT(fastest_radps * 180.0 / std::numbers::pi, 110.0) << seed;
    EXPECT_LT(fastest_radps * 180.0 / std::numbers::pi, 150.0) << seed;
  }
}

TEST_F(Office, TheWalkerTouchesNothing) {
  constexpr float kClearance_m = 0.3f;
  const int carrier = static_cast<int>(scenario_.world.movers.size()) - 1;
  for (double t = 0.5; t < scenario_.duration_s; t += 0.2) {
    const auto interval = scene_.During(t - 0.01, t + 0.01);
    for (int i = 0; i < 36; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 12.0;
      const Vector3 from = GroundAt(t) + Vector3(0.0, 0.0, 0.5 + 0.5 * (i / 12));
      const Vector3 direction(std::cos(angle), std::sin(angle), 0.0);
      const Ray ray{from.cast<float>(), direction.cast<float>(), 0.5f};
      Hit hit;
      interval.Cast({&ray, 1}, kClearance_m, {&hit, 1});
      EXPECT_TRUE(hit.object == Hit::kNothing || hit.object == carrier)
          << "at " << t << " s, " << from.transpose() << ": " << TraitsOf(hit.material).name;
    }
  }
}

TEST_F(Office, CorridorsAreNarrowAndLookAlikeOnEveryStorey) {
  const double x = 14.0;
  for (int storey = 0; storey < 3; ++storey) {
    const Vector3 at(x, 0.0, kStorey_m * storey + 1.3);
    EXPECT_NEAR(Range(at, Vector3::UnitY()) + Range(at, -Vector3::UnitY()), 1.6, 0.05);
    for (double angle = 0.6; angle < 2.5; angle += 0.1) {
      for (const double side : {-1.0, 1.0}) {
        const Vector3 direction(std::cos(angle), side * std::sin(angle), 0.1);
        EXPECT_NEAR(Range(at, direction), Range({x, 0.0, 1.3}, direction), 2e-3);
      }
    }
  }
}

TEST_F(Office, SlabsAndWallsAreThick) {
  for (int storey = 0; storey < 3; ++storey) {
    const Vector3 at(14.0, 0.4, kStorey_m * storey + 1.0);
    EXPECT_NEAR(Range(at, -Vector3::UnitZ()), 1.0, 1e-3);
    EXPECT_NEAR(Range(at, Vector3::UnitZ()), 2.0, 1e-3) << "the slab above is 0.3 m thick";
  }
  const double to_wall = Range({9.4, 0.0, 1.5}, Vector3::UnitY());
  const double from_room = Range({9.4, 3.0, 2.4}, -Vector3::UnitY());
  EXPECT_NEAR(3.0 - from_room - to_wall, 0.12, 1e-3);
}

TEST_F(Office, StairsAreStepsUpToTheHalfLandingAndOnToTheNextStorey) {
  constexpr double kTread_m = 0.28;
  constexpr double kRiser_m = 0.165;
  const auto floor_at = [&](double x, double y, double z) {
    return z - Range({x, y, z}, -Vector3::UnitZ());
  };
  for (int flight = 0; flight < 4; ++flight) {
    const bool is_first = flight % 2 == 0;
    const double base_m = 0.5 * kStorey_m * flight;
    for (int i = 0; i < 9; ++i) {
      const double from_m = is_first ? -1.8 - kTread_m * i : -1.8 - kTread_m * (9 - i);
      const double forward = is_first ? -1.0 : 1.0;
      for (const double share : {0.1, 0.9}) {  // a tread is level
        const double x = from_m + forward * share * kTread_m;
        EXPECT_NEAR(floor_at(x, is_first ? -0.7 : 0.7, base_m + 2.0), base_m + kRiser_m * (i + 1),
                    1e-3)
            << "flight " << flight << ", tread " << i;
      }
    }
  }
  EXPECT_NEAR(floor_at(-5.0, 0.0, 2.0), 0.5 * kStorey_m, 1e-3) << "the half-landing";
  EXPECT_NEAR(floor_at(-1.0, 0.0, kStorey_m + 1.0), kStorey_m, 1e-3) << "the landing";
  EXPECT_NEAR(Range({-3.0, -0.7, kStorey_m + 0.2},
                    Vector3(0.28, 0.0, -0.165).cross(Vector3::UnitY()).normalized()),
              Range({-3.0, -0.7, 0.2}, Vector3(0.28, 0.0, -0.165).cross(Vector3::UnitY())), 1e-3)
      << "a flight's underside is like that of the flight above";
}

TEST_F(Office, DoorsOpenForTheWalkerAndCloseBehindHim) {
  const Vector3 in_room(4.5, 2.0, 1.5);
  const Vector3 before_stairs(2.0, 0.0, 1.5);
  EXPECT_NEAR(Range(in_room, -Vector3::UnitY()), 2.0 - 0.88, 1e-3);
  EXPECT_NEAR(Range(before_stairs, -Vector3::UnitX()), 2.0 - 0.02, 1e-3);
  double passes_s = 0.0;
  while (GroundAt(passes_s).y() > 0.4) passes_s += 0.1;
  EXPECT_GT(RangeAt(passes_s, {4.5, 2.0, 2.0}, -Vector3::UnitY()), 2.5) << "open";
  while (GroundAt(passes_s).x() > 0.5) passes_s += 0.1;
  EXPECT_NEAR(RangeAt(passes_s, in_room, -Vector3::UnitY()), 2.0 - 0.88, 1e-3) << "closed again";
  EXPECT_GT(RangeAt(passes_s, {2.0, 0.0, 2.0}, -Vector3::UnitX()), 4.0)
      << "the stairwell's is open";
}

TEST_F(Office, IsSeenByTheSensorsOfAHandHeldRig) {
  EXPECT_EQ(scenario_.lidar_model, "vlp16");
  EXPECT_EQ(scenario_.min_range_m, 0.6);
  ASSERT_TRUE(scenario_.own_vehicle_box);
}

TEST_F(Office, FurnitureDependsOnTheSeedAndTheBuildingDoesNot) {
  ScenarioOptions options;
  options.seed = 2;
  const Scenario other = MakeScenario("office", options);
  EXPECT_NE(other.world.fixed.Whole().vertices_m, scenario_.world.fixed.Whole().vertices_m);
  const Scene scene(other.world);
  const Ray ray{Vector3f(14.0f, 0.0f, 1.5f), Vector3f::UnitY(), 0.5f};
  Hit hit;
  scene.During(0.0, 0.1).Cast({&ray, 1}, 99.0f, {&hit, 1});
  EXPECT_NEAR(hit.range_m, Range({14.0, 0.0, 1.5}, Vector3::UnitY()), 1e-6);
}

}  // namespace
}  // namespace lio::sim
