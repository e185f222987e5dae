// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A place, a way through it and how the sensors are carried: everything lio-sim needs but the
// sensors themselves.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lio/sensor/rig.hpp"
#include "lio/sim/trajectory.hpp"
#include "lio/sim/world.hpp"

namespace lio::sim {

struct ScenarioOptions {
  std::uint64_t seed = 1;
  std::optional<double> duration_s;  // the scenario's own when absent
  bool starts_moving = false;        // else 2.5 s at rest come first
};

struct Scenario {
  std::string name;
  World world;
  std::shared_ptr<const Trajectory> trajectory;
  double begin_s = 0.0;     // trajectory time at which the log begins
  double duration_s = 0.0;  // of the log
  Pose T_imu_lidar;
  std::optional<OwnVehicleBox> own_vehicle_box;  // lidar frame
  double min_range_m = 1.5;                      // for the rig
  std::string lidar_model = "hdl32e";            // when the user names none
  std::string imu_model = "xsens_mti10";
  // Pictures from above leave out what is this much higher than the way, or lies above a plane of
  // this slope there.
  double ceiling_m = 1e9;
  double view_width_m = 300.0;  // a longer way is shown in part, around where the body is at
  double view_share = 0.35;     // this share of the log
  Vector2 ceiling_slope_ratio = Vector2::Zero();
};

struct ScenarioEntry {
  std::string name;
  std::string summary;
};
const std::vector<ScenarioEntry>& AllScenarios();

// Throws std::invalid_argument naming the scenarios when there is none of that name or the duration
// is not positive.
Scenario MakeScenario(const std::string& name, const ScenarioOptions& options);

}  // namespace lio::sim
