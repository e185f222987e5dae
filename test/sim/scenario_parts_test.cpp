// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/scenario_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/mesh_checks.hpp"

namespace lio::sim {
namespace {

// The motion is 2 s at rest, then along x with 2 m/s^2 up to 10 m/s.
MotionPlan StartAndGo() {
  MotionPlan plan;
  plan.knot_interval_s = 0.2;
  for (int i = 0; i <= 60; ++i) {
    const double t_s = 0.2 * i - 2.0;
    BodyKnot knot;
    if (t_s > 0) knot.position_m.x() = t_s < 5.0 ? t_s * t_s : 25.0 + 10.0 * (t_s - 5.0);
    plan.knots.push_back(knot);
  }
  return plan;
}

bool IsInside(const OwnVehicleBox& box, const Vector3& p) {
  return (p.array() >= box.min_m.array()).all() && (p.array() <= box.max_m.array()).all();
}

using Mount = void (*)(Scenario&, MotionPlan);
class Mounts : public ::testing::TestWithParam<Mount> {
 protected:
  Mounts() { GetParam()(scenario_, StartAndGo()); }
  Scenario scenario_;
};

TEST_P(Mounts, TheCarrierGoesWithTheBody) {
  ASSERT_EQ(scenario_.world.movers.size(), 1u);
  ASSERT_EQ(scenario_.world.shapes.size(), 1u);
  for (const double t_s : {0.0, 4.0, 9.0}) {
    const Pose carrier = scenario_.world.movers[0].T_world_mover(t_s);
    const Pose body = scenario_.trajectory->BodyPoseAt(t_s);
    EXPECT_EQ(carrier.translation, body.translation);
    EXPECT_EQ(carrier.rotation.coeffs(), body.rotation.coeffs());
  }
}

TEST_P(Mounts, TheBoxHoldsWhatIsCarriedAndWhoCarries) {
  ASSERT_TRUE(scenario_.own_vehicle_box);
  const Pose T_body_lidar = scenario_.trajectory->T_body_imu() * scenario_.T_imu_lidar;
  const Pose T_lidar_body = T_body_lidar.Inverse();
  int num_outside = 0;
  for (const Vector3f& vertex : scenario_.world.shapes[0].vertices_m) {
    const Vector3 p = T_lidar_body * vertex.cast<double>();
    num_outside += !IsInside(*scenario_.own_vehicle_box, p) && p.norm() > scenario_.min_range_m;
  }
  EXPECT_EQ(num_outside, 0);
}

TEST_P(Mounts, TheLidarSitsAboveTheImuOnTheBody) {
  const Pose& T_body_imu = scenario_.trajectory->T_body_imu();
  const Vector3 lidar = T_body_imu * scenario_.T_imu_lidar.translation;
  EXPECT_GT(lidar.z(), T_body_imu.translation.z() + 0.1);
  EXPECT_GT(lidar.z(), 1.4);
  EXPECT_LT(lidar.z(), 2.1);
}

INSTANTIATE_TEST_SUITE_P(All, Mounts, ::testing::Values(&MountOnCar, &MountOnPerson),
                         [](const auto& test) {
                           return test.param == &MountOnCar ? "Car" : "Person";
                         });

TEST(ScenarioParts, TheCarsLidarIsTurnedByAQuarter) {
  Scenario scenario;
  MountOnCar(scenario, StartAndGo());
  // The lidar's x points to the car's right.
  const Vector3 x = scenario.T_imu_lidar.rotation * Vector3::UnitX();
  EXPECT_GT(-x.y(), std::cos(0.03));
  EXPECT_FALSE(IsInside(*scenario.own_vehicle_box, Vector3(0, 3, -1))) << "the road ahead is seen";
}

TEST(ScenarioParts, LogsBeginAtRestUnlessAskedForMotion) {
  Scenario scenario;
  MountOnPerson(scenario, StartAndGo());
  ScenarioOptions options;
  scenario.begin_s = 77.0;
  SetBegin(scenario, options, 4.0);
  EXPECT_EQ(scenario.begin_s, 0.0);
  options.starts_moving = true;
  SetBegin(scenario, options, 4.0);
  EXPECT_NEAR(scenario.begin_s, 4.0, 0.21);  // 2 s at rest, 2 s of 2 m/s^2
  EXPECT_GE(scenario.trajectory->At(scenario.begin_s).v_world_mps.norm(), 4.0);
  EXPECT_LT(scenario.trajectory->At(scenario.begin_s - 0.1).v_world_mps.norm(), 4.0);
}

TEST(ScenarioParts, ASpeedThatIsNeverReachedEndsTheSearch) {
  Scenario scenario;
  MountOnPerson(scenario, StartAndGo());
  ScenarioOptions options;
  options.starts_moving = true;
  SetBegin(scenario, options, 1000.0);
  EXPECT_NEAR(scenario.begin_s, scenario.trajectory->duration_s(), 0.11);
}

TEST(ScenarioParts, TerrainIsAHeightFunction) {
  Random random(1, Purpose::kWorld);
  HeightFunction height;
  double expected_m = 0.0;
  {
    const Terrain terrain({{0.02, 0.0}, 0.8, 0.01}, random);
    expected_m = terrain.Height({30, 40});
    height = HeightOf(terrain);  // the function must outlive it
  }
  EXPECT_EQ(height({30, 40}, 0.0), expected_m);
  EXPECT_EQ(height({30, 40}, 500.0), expected_m) << "whatever the storey";
}

}  // namespace
}  // namespace lio::sim
