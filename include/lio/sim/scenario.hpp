// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Describes a place, a path through it and how the sensors are carried: all that lio-sim needs
// besides the sensors.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lio/sensor/rig.hpp"
#include "lio/sim/trajectory.hpp"
#include "lio/sim/world.hpp"

namespace lio::sim {

enum class Carrier {
  kPerson,  // by hand, 1.4 m above the floor
  kRobot,   // on a small wheeled robot, 0.5 m above the floor
  kDrone,   // on a multicopter that takes off, leans with its acceleration and looks about
};

struct ScenarioOptions {
  std::uint64_t seed = 1;
  std::optional<double> duration_s;  // absent: the scenario's own
  bool starts_moving = false;        // false: the log begins with 2.5 s at rest
  std::optional<Carrier> carrier{};  // absent: the scenario's own
};

struct Scenario {
  std::string name;
  World world;
  std::shared_ptr<const Trajectory> trajectory;
  double begin_s = 0.0;     // trajectory time at which the log begins
  double duration_s = 0.0;  // duration of the log
  bool is_on_car = false;   // with engine and wheels
  // The carrier's motors add this white noise to each sample of the IMU, 1 sigma, in the field.
  double shake_accel_mps2 = 0.0;
  double shake_gyro_radps = 0.0;
  double dust_per_m = 0.0;  // echoes of dust in the air per metre of ray, all the time
  Pose T_imu_lidar;
  std::optional<OwnVehicleBox> own_vehicle_box;  // box in the lidar frame
  double min_range_m = 1.5;                      // written into the rig
  std::string lidar_model = "hdl32e";            // used when the user names no model
  std::string imu_model = "xsens_mti10";
  // Pictures from above leave out everything that is this much higher than the sensor's path, or
  // lies above a plane of this slope there.
  double ceiling_m = 1e9;
  double view_width_m = 300.0;  // only this part of a longer path is drawn, around the body
  double view_share = 0.35;     // the body is drawn where it is at this share of the log
  Vector2 ceiling_slope_ratio = Vector2::Zero();
};

struct ScenarioEntry {
  std::string name;
  std::string summary;
};
[[nodiscard]] const std::vector<ScenarioEntry>& AllScenarios();

// Throws std::invalid_argument that lists the scenarios when there is none of that name, when the
// duration is not positive, or when a carrier is asked for in a place that is built for another.
[[nodiscard]] Scenario MakeScenario(const std::string& name, const ScenarioOptions& options);

}  // namespace lio::sim
