// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Sweeps of a lidar with the errors of a grade, or with one effect of the field alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lio/sim/realism.hpp"
#include "sim/closed_room.hpp"

namespace lio::test {

inline sim::RecordOptions OptionsOf(sim::Realism realism,
                                    const std::vector<std::string>& without = {},
                                    const std::string& lidar = "hdl32e") {
  sim::RecordOptions options;
  options.lidar = sim::LoadLidarModel(lidar);
  options.imu = sim::LoadImuModel("xsens_mti10");
  SetRealism(realism, {{}, without}, options);
  return options;
}

// Switches on this effect of the field alone, without the errors of the data sheet.
inline sim::RecordOptions Only(const std::string& effect) {
  std::vector<std::string> without = sim::FieldEffects();
  std::erase(without, effect);
  sim::RecordOptions options = OptionsOf(sim::Realism::kField, without);
  options.lidar_errors.noise_scale = 0.0;
  options.lidar_errors.dropout_ratio = 0.0;
  options.lidar_errors.has_weak_echoes = false;
  options.lidar.range_step_m = 0.0;
  options.lidar_errors.has_mixed_pixels = false;
  return options;
}

// The sensor stands still at the origin.
inline sim::SimulatedSweep SweepIn(const sim::World& world, const sim::RecordOptions& options,
                                   std::uint64_t seed = 5) {
  const sim::Trajectory still = Still();
  const sim::Scene scene(world);
  return sim::LidarSimulator({options.lidar, Pose::Identity(), options.lidar_errors, seed, 0.0},
                             scene, still)
      .Sweep(0);
}

// Returns the range of a point less that of the room's surface along the same beam.
inline double RoomError(const LidarPoint& point) {
  const Vector3 p(point.x_m, point.y_m, point.z_m);
  const double height_m = p.z() > 0.0 ? 7.0 : 2.0;
  const double of_the_way =
      std::max({std::abs(p.x()) / 20.0, std::abs(p.y()) / 15.0, std::abs(p.z()) / height_m});
  return p.norm() * (1.0 - 1.0 / of_the_way);
}

}  // namespace lio::test
