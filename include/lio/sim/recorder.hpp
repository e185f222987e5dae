// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs sensors through a scenario and writes their measurements and the truth:
//   log.lcm           LIO_IMU and LIO_SCAN, each event at the time it would have been received
//   truth.tum         pose of imu in world at each IMU instant: t x y z qx qy qz qw
//   truth_states.csv  velocity, biases and rates at the same instants
//   config.yaml       the rig, for lio-replay and liod
// The bytes depend on the options alone, not on the number of threads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "lio/sim/clock_errors.hpp"
#include "lio/sim/fault.hpp"
#include "lio/sim/imu_simulator.hpp"
#include "lio/sim/lidar_simulator.hpp"
#include "lio/sim/scenario.hpp"

namespace lio::sim {

struct RecordOptions {
  LidarModel lidar;
  LidarErrors lidar_errors;
  ImuModel imu;
  std::optional<ImuModel> claimed_imu;  // whose densities config.yaml has; absent: those of `imu`
  ImuVariant imu_variant = ImuVariant::kNormal;
  ImuEffects imu_effects;
  ClockErrors clock_errors;
  double gravity_mps2 = 9.80665;
  std::vector<Fault> faults;
  // Names a log of the same drive and lidar whose scans are taken instead of casting them; empty:
  // none. Its own clocks must have been without errors.
  std::filesystem::path scans;
  std::uint64_t seed = 1;
  int num_threads = 1;
};

struct RecordStats {
  std::int64_t num_imu = 0;
  std::int64_t num_sweeps = 0;
  std::int64_t num_chunks = 0;
  std::int64_t num_rays = 0;
  std::int64_t num_points = 0;
  std::int64_t num_in_between = 0;  // mixed pixels
  std::int64_t num_mirrored = 0;
  std::int64_t num_through_glass = 0;
};

// Creates the folder. `progress` is called with the share done, 0..1, and may be empty. Throws
// std::runtime_error when something cannot be written.
RecordStats Record(const Scenario& scenario, const RecordOptions& options,
                   const std::filesystem::path& folder,
                   const std::function<void(double)>& progress);

// Returns the paths of the files that Record writes into the folder.
[[nodiscard]] std::vector<std::filesystem::path> FilesOf(const std::filesystem::path& folder);

// Returns the sensor time of a trajectory time: trajectories begin at a stamp of late 2023.
[[nodiscard]] Timestamp StampOf(std::int64_t trajectory_ns);

}  // namespace lio::sim
