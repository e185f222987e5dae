// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the messages that the sensors send on a drive through a scene, and runs the estimator over
// them.
#pragma once

#include <string>
#include <vector>

#include "lio/pipeline/found_sensors.hpp"
#include "lio/pipeline/odometry.hpp"
#include "support/motion.hpp"
#include "support/scene.hpp"

namespace lio::test {

struct Message {
  Timestamp arrival;
  bool is_imu = true;
  ImuSample sample;
  ScanChunk chunk;
};
using Messages = std::vector<Message>;  // in order of arrival

// The clock starts 4 s into the drive, at 8 m/s and turning.
inline Motion Driving() {
  return [](double t_s) { return WindingDrive(0.0)(t_s + 4.0); };
}

struct DriveOptions {
  Motion motion;
  double imu_from_s = 0.0;
  double lidar_from_s = 0.0;
  double to_s = 5.0;
  double imu_step_s = 0.01;
  int chunks_per_sweep = 3;
  // The next values are the errors of the IMU.
  double gyro_density = 2e-4;
  double accel_density = 2e-3;
  Vector3 gyro_bias{0.002, -0.001, 0.0015};
  Vector3 accel_bias{0.02, -0.01, 0.03};
  Vector3 g_world = kGravity;  // zero for an IMU that removes gravity
};

Messages SimulateDrive(const Scene& scene, const DriveOptions& options);

// Returns options for TestLidar() and the IMU of DriveOptions.
Options DriveRig();

struct RunResult {
  std::vector<ScanOutput> scans;
  std::vector<NavOutput> navs;
  std::vector<Notice> notices;
  Counters counters;
  TrackingStatus status = TrackingStatus::kInit;
  Verdict verdict;
  FoundSensors found;
};

// `lag` is the number of messages between a job's start and its end, as with a slow matching
// thread.
RunResult RunOdometry(const Messages& messages, const Options& options, int lag = 0,
                      const FoundSensors& known = {});

// Returns everything in the scans' outputs except computing times, bit by bit.
std::string Bytes(const std::vector<ScanOutput>& scans);

struct TrackError {
  double max_m = 0.0;  // error of the path from the first output's pose on
  double max_rad = 0.0;
  double max_tilt_rad = 0.0;  // largest angle between the output's vertical and the true one
  double end_m = 0.0;
};
// Returns the error of the path in map for stamps from `from_s` on. Stamps that were shifted are
// shifted back by `shift_s`.
TrackError ErrorAgainst(const Motion& motion, const std::vector<ScanOutput>& scans,
                        double from_s = -1e9, double shift_s = 0.0);

bool HasNotice(const RunResult& run, const std::string& part);

}  // namespace lio::test
