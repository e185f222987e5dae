// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <stdexcept>

#include "lio/sim/lidar_simulator.hpp"

namespace lio::sim {
namespace {

class Scenarios : public ::testing::TestWithParam<std::string> {
 protected:
  static bool IsOnFoot(const std::string& name) {
    return name == "campus" || name == "hall" || name == "office";
  }
  static bool IsOnRobot(const std::string& name) {
    return name == "mine" || name == "warehouse" || name == "hedgerows";
  }
};

TEST_P(Scenarios, BeginAtRestThenMoveWithinTheLimitsOfTheirCarrier) {
  const Scenario scenario = MakeScenario(GetParam(), {});
  ASSERT_GT(scenario.duration_s, 30.0);
  const double rest_s = scenario.name == "parked" ? scenario.duration_s : 2.0;
  double most_mps = 0.0;
  double most_mps2 = 0.0;
  double most_radps = 0.0;
  // The limits apply to the body on the ground; the sensor above it sways and is swung about.
  const auto ground = [&](double t) -> Vector3 {
    return scenario.trajectory->BodyPoseAt(t).translation;
  };
  constexpr double kStep_s = 0.05;
  for (double t = kStep_s; t < scenario.duration_s; t += 0.02) {
    const Kinematics k = scenario.trajectory->At(t);
    if (t < rest_s) {
      EXPECT_LT(k.v_world_mps.norm(), 0.02) << "at " << t;
      EXPECT_LT(k.w_imu_radps.norm(), 0.01) << "at " << t;
    }
    const Vector3 ahead = ground(t + kStep_s) - ground(t);
    const Vector3 behind = ground(t) - ground(t - kStep_s);
    most_mps = std::max(most_mps, (ahead + behind).norm() / (2.0 * kStep_s));
    most_mps2 = std::max(most_mps2, (ahead - behind).head<2>().norm() / (kStep_s * kStep_s));
    most_radps = std::max(most_radps, k.w_imu_radps.norm());
  }
  if (IsOnFoot(scenario.name)) {
    EXPECT_LT(most_mps, 3.0);
    EXPECT_LT(most_mps2, 3.0);
  } else if (IsOnRobot(scenario.name)) {
    EXPECT_LT(most_mps, 1.6);
    EXPECT_LT(most_mps2, 3.0);
    EXPECT_LT(most_radps, 2.0);
  } else {
    EXPECT_LT(most_mps, 30.0);
    EXPECT_LT(most_mps2, 3.2);  // 2 to 2.2 m/s^2, longitudinal and lateral at once
    EXPECT_LT(most_radps, 1.2);
  }
  if (scenario.name == "hall") {
    EXPECT_GT(most_radps, 250.0 / 180.0 * std::numbers::pi);
    EXPECT_LT(most_radps, 320.0 / 180.0 * std::numbers::pi);
  }
  if (scenario.name == "motorway") {
    EXPECT_GT(most_mps, 27.0);
  }
}

// The rays go along both flanks of the car, just outside of it, at the height of bumpers and of
// mirrors.
TEST_P(Scenarios, DriveThroughNothingAndNobody) {
  if (IsOnFoot(GetParam())) GTEST_SKIP() << "walkers are covered by what the sensor sees near by";
  const Scenario scenario = MakeScenario(GetParam(), {});
  const Scene scene(scenario.world);
  const float length_m = IsOnRobot(GetParam()) ? 0.8f : 4.4f;
  const double half_width_m = IsOnRobot(GetParam()) ? 0.38 : 0.92;
  for (double t = 0.5; t < scenario.duration_s; t += 0.4) {
    const auto interval = scene.During(t - 0.05, t + 0.05);
    const Pose body = scenario.trajectory->BodyPoseAt(t);
    for (const double y : {-half_width_m, half_width_m}) {
      for (const double z : {0.6, 1.0}) {
        const Vector3 from = body * Vector3(-0.5 * double{length_m}, y, z);
        const Ray ray{from.cast<float>(), (body.rotation * Vector3::UnitX()).cast<float>(), 0.5f};
        Hit hit;
        interval.Cast({&ray, 1}, length_m, {&hit, 1});
        EXPECT_EQ(hit.object, Hit::kNothing)
            << "at " << t << " s, " << y << " m to the left, " << z
            << " m high: " << TraitsOf(hit.material).name << " at "
            << (from + double{hit.range_m} * (body.rotation * Vector3::UnitX())).transpose();
      }
    }
  }
}

TEST_P(Scenarios, CarryTheSensorThroughFreeSpaceWithEnoughToSee) {
  ScenarioOptions options;
  options.duration_s = 40.0;
  const Scenario scenario = MakeScenario(GetParam(), options);
  const Scene scene(scenario.world);
  LidarSetup setup;
  setup.model = LoadLidarModel("vlp16");
  setup.T_imu_lidar = scenario.T_imu_lidar;
  const LidarSimulator lidar(setup, scene, *scenario.trajectory);
  for (std::int64_t index = 0; index < 400; index += 37) {
    const SimulatedSweep sweep = lidar.Sweep(index);
    EXPECT_GT(sweep.points.size(), 0.3 * static_cast<double>(sweep.num_rays)) << index;
    std::size_t num_fixed_near = 0;
    for (std::size_t i = 0; i < sweep.points.size(); ++i) {
      const LidarPoint& p = sweep.points[i];
      const bool near = std::hypot(p.x_m, p.y_m) < 1.2f && p.z_m > -0.5f;
      num_fixed_near += near && sweep.objects[i] == Hit::kFixed ? 1 : 0;
    }
    // Walls and floor are near by: scenario_office_test.cpp, carrier_test.cpp.
    if (GetParam() == "office" || IsOnRobot(GetParam())) continue;
    EXPECT_LT(num_fixed_near, 30u) << "something stands in the way of sweep " << index;
  }
}

TEST_P(Scenarios, OwnVehicleBoxHoldsTheCarrierAndLeavesTheWorld) {
  ScenarioOptions options;
  options.duration_s = 12.0;
  const Scenario scenario = MakeScenario(GetParam(), options);
  ASSERT_TRUE(scenario.own_vehicle_box);
  const Scene scene(scenario.world);
  LidarSetup setup;
  setup.model = LoadLidarModel("hdl32e");
  setup.model.min_range_m = 0.1;  // all of it must be visible
  setup.errors.dropout_ratio = 0.0;
  setup.T_imu_lidar = scenario.T_imu_lidar;
  const LidarSimulator lidar(setup, scene, *scenario.trajectory);
  const int carrier = static_cast<int>(scenario.world.movers.size()) - 1;
  int num_carrier = 0;
  int num_outside = 0;
  const SimulatedSweep sweep = lidar.Sweep(30);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    if (sweep.objects[i] != carrier) continue;
    const Vector3 p(sweep.points[i].x_m, sweep.points[i].y_m, sweep.points[i].z_m);
    const bool inside = (p.array() >= scenario.own_vehicle_box->min_m.array()).all() &&
                        (p.array() <= scenario.own_vehicle_box->max_m.array()).all();
    ++num_carrier;
    num_outside += inside || p.norm() < scenario.min_range_m ? 0 : 1;
  }
  EXPECT_GT(num_carrier, 200);
  EXPECT_LT(num_outside, num_carrier / 100);
}

TEST_P(Scenarios, AreTheSameForTheSameSeed) {
  ScenarioOptions options;
  options.duration_s = 8.0;
  const Scenario a = MakeScenario(GetParam(), options);
  const Scenario b = MakeScenario(GetParam(), options);
  ASSERT_EQ(a.world.fixed.Whole().vertices_m.size(), b.world.fixed.Whole().vertices_m.size());
  EXPECT_EQ(a.world.fixed.Whole().vertices_m, b.world.fixed.Whole().vertices_m);
  EXPECT_EQ(a.world.movers.size(), b.world.movers.size());
  EXPECT_EQ(a.trajectory->At(5.0).T_world_imu.translation,
            b.trajectory->At(5.0).T_world_imu.translation);
}

TEST_P(Scenarios, MayBeginInMotion) {
  if (GetParam() == "parked") GTEST_SKIP() << "a parked car does not move";
  ScenarioOptions options;
  options.duration_s = 20.0;
  options.starts_moving = true;
  const Scenario scenario = MakeScenario(GetParam(), options);
  const Kinematics k = scenario.trajectory->At(scenario.begin_s);
  EXPECT_GT(k.v_world_mps.norm(), 0.25);
  EXPECT_GE(scenario.trajectory->duration_s(), scenario.begin_s);
  double hardest_mps2 = 0.0;
  for (double t_s = scenario.begin_s; t_s < scenario.begin_s + 19.0; t_s += 0.1) {
    const Vector3 change =
        scenario.trajectory->At(t_s + 1.0).v_world_mps - scenario.trajectory->At(t_s).v_world_mps;
    hardest_mps2 = std::max(hardest_mps2, change.norm());
  }
  EXPECT_LT(hardest_mps2, 7.0) << "mean over a second: the way goes on to the log's end";
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  for (const ScenarioEntry& entry : AllScenarios()) names.push_back(entry.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, Scenarios, ::testing::ValuesIn(Names()),
                         [](const auto& test) { return test.param; });

TEST(Scenario, AllThirteenAreThere) {
  const std::vector<std::string> names = Names();
  EXPECT_EQ(
      std::set<std::string>(names.begin(), names.end()),
      (std::set<std::string>{"street", "loop", "suburb", "tunnel", "motorway", "garage", "campus",
                             "hall", "office", "mine", "warehouse", "hedgerows", "parked"}));
}

TEST(Scenario, PlacesBuiltForOneCarrierRefuseOthers) {
  ScenarioOptions options;
  options.carrier = Carrier::kDrone;
  EXPECT_THROW((void)MakeScenario("street", options), std::invalid_argument);
}

TEST(Scenario, LoopIsLongEnoughAndEndsWhereItBegan) {
  const Scenario loop = MakeScenario("loop", {});
  double length_m = 0.0;
  Vector3 last = loop.trajectory->At(0.0).T_world_imu.translation;
  for (double t = 0.0; t <= loop.duration_s; t += 0.05) {
    const Vector3 now = loop.trajectory->At(t).T_world_imu.translation;
    length_m += (now - last).norm();
    last = now;
  }
  EXPECT_GE(length_m, 600.0);
  const Pose begin = loop.trajectory->At(0.0).T_world_imu;
  const Pose end = loop.trajectory->At(loop.duration_s).T_world_imu;
  EXPECT_LT((begin.translation - end.translation).norm(), 1e-6);
  EXPECT_LT(begin.rotation.angularDistance(end.rotation), 1e-6);
}

TEST(Scenario, GarageClimbsFromStoreyToStorey) {
  const Scenario garage = MakeScenario("garage", {});
  const double rise = garage.trajectory->At(garage.duration_s).T_world_imu.translation.z() -
                      garage.trajectory->At(0.0).T_world_imu.translation.z();
  EXPECT_GT(rise, 6.0);
}

TEST(Scenario, TunnelTellsNothingAlongItsAxis) {
  const Scenario tunnel = MakeScenario("tunnel", {});
  const Scene scene(tunnel.world);
  const auto interval = scene.During(0.0, 0.1);
  // In the middle of the tube the walls look the same a metre further.
  for (const double x : {120.0, 250.0, 400.0}) {
    for (double angle = -1.4; angle < 4.5; angle += 0.2) {
      const Vector3f direction(0.0f, static_cast<float>(std::cos(angle)),
                               static_cast<float>(std::sin(angle)));
      float ranges[2] = {0.0f, 0.0f};
      for (int k = 0; k < 2; ++k) {
        const double at = x + 1.0 * k;
        const Ray ray{Vector3f(static_cast<float>(at), 0.0f, static_cast<float>(0.012 * at + 2.0)),
                      direction, 0.0f};
        Hit hit;
        interval.Cast({&ray, 1}, 50.0f, {&hit, 1});
        ranges[k] = hit.range_m;
      }
      EXPECT_NEAR(ranges[0], ranges[1], 2e-3) << "at " << x << ", angle " << angle;
    }
  }
}

TEST(Scenario, UnknownNamesAndBadDurationsAreRefused) {
  try {
    (void)MakeScenario("stret", {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("street"), std::string::npos);
  }
  ScenarioOptions options;
  options.duration_s = -1.0;
  EXPECT_THROW((void)MakeScenario("street", options), std::invalid_argument);
}

}  // namespace
}  // namespace lio::sim
