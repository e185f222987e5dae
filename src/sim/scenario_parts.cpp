// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "scenario_parts.hpp"

#include <utility>

#include "lio/base/angle.hpp"

namespace lio::sim {
namespace {

Quaternion FromDegrees(double yaw, double pitch, double roll) {
  return Quaternion(Eigen::AngleAxisd(kRadPerDeg * yaw, Vector3::UnitZ()) *
                    Eigen::AngleAxisd(kRadPerDeg * pitch, Vector3::UnitY()) *
                    Eigen::AngleAxisd(kRadPerDeg * roll, Vector3::UnitX()));
}

// Returns the smallest box in the lidar's frame around a box in the body's frame.
OwnVehicleBox BoxInLidar(const Pose& T_lidar_body, const Vector3& low, const Vector3& high) {
  OwnVehicleBox box{Vector3::Constant(1e9), Vector3::Constant(-1e9)};
  for (int i = 0; i < 8; ++i) {
    const Vector3 corner((i & 1) ? high.x() : low.x(), (i & 2) ? high.y() : low.y(),
                         (i & 4) ? high.z() : low.z());
    const Vector3 p = T_lidar_body * corner;
    box.min_m = box.min_m.cwiseMin(p);
    box.max_m = box.max_m.cwiseMax(p);
  }
  return box;
}

void AddCarrier(Scenario& scenario, Mesh shape) {
  scenario.world.shapes.push_back(std::move(shape));
  scenario.world.movers.push_back(
      {scenario.world.shapes.size() - 1,
       [trajectory = scenario.trajectory](double t_s) { return trajectory->BodyPoseAt(t_s); }});
}

}  // namespace

void MountOnCar(Scenario& scenario, MotionPlan plan) {
  scenario.is_on_car = true;
  plan.T_body_imu = {FromDegrees(1.0, -0.8, 0.5), {0.25, -0.08, 1.62}};
  scenario.T_imu_lidar = {FromDegrees(-90.0, 1.2, -0.6), {0.04, -0.03, 0.30}};
  scenario.trajectory = std::make_shared<Trajectory>(plan);
  Mesh car;
  const auto at = [](double x, double y, double z) {
    return Pose{Quaternion::Identity(), {x, y, z}};
  };
  AddBox(car, at(0.0, 0.0, 0.25), {4.3, 1.76, 0.65}, Material::kCarPaint);
  Taper cabin;
  cabin.bottom_m = {2.9, 1.66};
  cabin.top_m = {1.7, 1.3};
  cabin.height_m = 0.58;
  AddTaper(car, at(-0.1, 0.0, 0.9), cabin, Material::kGlass, Material::kCarPaint);
  for (const double x : {-0.6, 0.5}) {  // roof bars
    AddBar(car, {x, -0.62, 1.53}, {x, 0.62, 1.53}, 0.025, 0.025, 6, Material::kDarkMetal);
  }
  AddBar(car, {-0.75, 0.0, 1.48}, {-0.9, 0.0, 2.05}, 0.012, 0.006, 5, Material::kDarkMetal);
  AddCarrier(scenario, std::move(car));
  const Pose T_lidar_body = (plan.T_body_imu * scenario.T_imu_lidar).Inverse();
  scenario.own_vehicle_box = BoxInLidar(T_lidar_body, {-2.4, -1.1, -0.1}, {2.4, 1.1, 1.75});
  scenario.min_range_m = 1.5;
}

void MountOnPerson(Scenario& scenario, MotionPlan plan) {
  plan.T_body_imu = {FromDegrees(2.0, 3.0, -1.5), {0.0, 0.0, 1.42}};
  scenario.T_imu_lidar = {FromDegrees(4.0, -5.0, 2.0), {0.02, -0.01, 0.12}};
  scenario.trajectory = std::make_shared<Trajectory>(plan);
  Mesh carrier;
  Random random(1, Purpose::kMount);
  AddMesh(carrier, MakePerson(random), {Quaternion::Identity(), {-0.55, 0.0, 0.0}});
  AddBar(carrier, {0.0, 0.0, 0.9}, {0.0, 0.0, 1.38}, 0.02, 0.02, 6, Material::kDarkMetal);
  AddCarrier(scenario, std::move(carrier));
  const Pose T_lidar_body = (plan.T_body_imu * scenario.T_imu_lidar).Inverse();
  scenario.own_vehicle_box = BoxInLidar(T_lidar_body, {-0.95, -0.45, 0.0}, {0.1, 0.45, 1.9});
  scenario.min_range_m = 0.6;
  scenario.ceiling_m = 2.4;
}

void MountOnRobot(Scenario& scenario, MotionPlan plan) {
  plan.T_body_imu = {FromDegrees(-1.5, 0.7, 0.4), {0.05, 0.02, 0.36}};
  scenario.T_imu_lidar = {FromDegrees(90.5, -0.8, 0.6), {0.03, -0.02, 0.14}};
  scenario.trajectory = std::make_shared<Trajectory>(plan);
  Mesh robot;
  AddBox(robot, {Quaternion::Identity(), {0.0, 0.0, 0.1}}, {0.6, 0.45, 0.24},
         Material::kCarPaintDark);
  for (const double x : {-0.2, 0.2}) {
    for (const double side : {-1.0, 1.0}) {
      AddBar(robot, {x, 0.25 * side, 0.12}, {x, 0.33 * side, 0.12}, 0.12, 0.12, 12,
             Material::kRubber);
    }
  }
  AddBar(robot, {-0.22, 0.12, 0.3}, {-0.22, 0.12, 0.75}, 0.006, 0.004, 5, Material::kDarkMetal);
  AddCarrier(scenario, std::move(robot));
  const Pose T_lidar_body = (plan.T_body_imu * scenario.T_imu_lidar).Inverse();
  scenario.own_vehicle_box = BoxInLidar(T_lidar_body, {-0.35, -0.36, 0.0}, {0.35, 0.36, 0.42});
  scenario.min_range_m = 0.4;
  scenario.shake_accel_mps2 = 0.3;
  scenario.shake_gyro_radps = 0.005;
}

void MountOnDrone(Scenario& scenario, MotionPlan plan) {
  plan.T_body_imu = {FromDegrees(1.0, -1.2, 0.8), {-0.02, 0.01, 0.18}};
  scenario.T_imu_lidar = {FromDegrees(-2.0, 1.0, 179.0), {0.03, 0.0, 0.12}};
  scenario.trajectory = std::make_shared<Trajectory>(plan);
  Mesh drone;
  AddBox(drone, {Quaternion::Identity(), {0.0, 0.0, 0.1}}, {0.24, 0.16, 0.1}, Material::kCarPaint);
  for (const double x : {-0.28, 0.28}) {
    for (const double y : {-0.28, 0.28}) {
      AddBar(drone, {0.0, 0.0, 0.15}, {x, y, 0.17}, 0.012, 0.01, 6, Material::kDarkMetal);
      AddBar(drone, {x, y, 0.15}, {x, y, 0.2}, 0.02, 0.02, 8, Material::kDarkMetal);
      AddBar(drone, {0.4 * x, 0.4 * y, 0.1}, {0.6 * x, 0.6 * y, 0.0}, 0.008, 0.008, 5,
             Material::kDarkMetal);
    }
  }
  AddCarrier(scenario, std::move(drone));
  const Pose T_lidar_body = (plan.T_body_imu * scenario.T_imu_lidar).Inverse();
  scenario.own_vehicle_box = BoxInLidar(T_lidar_body, {-0.4, -0.4, -0.05}, {0.4, 0.4, 0.26});
  scenario.min_range_m = 0.4;
  scenario.shake_accel_mps2 = 0.8;
  scenario.shake_gyro_radps = 0.01;
}

HeightFunction HeightOf(const Terrain& terrain) {
  return [terrain](const Vector2& p_m, double) { return terrain.Height(p_m); };
}

double PlannedSeconds(const Scenario& scenario, const ScenarioOptions& options) {
  constexpr double kAfterEnd_s = 4.0;
  constexpr double kRunUp_s = 15.0;
  return scenario.duration_s + kAfterEnd_s + (options.starts_moving ? kRunUp_s : 0.0);
}

void SetBegin(Scenario& scenario, const ScenarioOptions& options, double moving_mps) {
  scenario.begin_s = 0.0;
  if (!options.starts_moving) return;
  const double step_s = 0.1;
  while (scenario.begin_s < scenario.trajectory->duration_s() &&
         scenario.trajectory->At(scenario.begin_s).v_world_mps.norm() < moving_mps) {
    scenario.begin_s += step_s;
  }
}

}  // namespace lio::sim
