// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Feeds the filter with the true poses of a recorded drive, made noisy and late, as if from
// registration, and compares it with the truth.
#pragma once

#include <vector>

#include "lio/filter/process_model.hpp"
#include "support/euroc.hpp"

namespace lio::test {

inline constexpr double kFedPoseStd_m = 0.02;
inline constexpr double kFedPoseStd_rad = 0.2 * M_PI / 180.0;
inline constexpr Duration kFedPoseDelay{100'000'000};
inline constexpr double kSettle_s = 5.0;  // the time before is not judged

// Holds the truth with velocity by five-point differences, if these exist, and the gyro's bias as
// the mean difference between its rates and the true turns in the surrounding ten seconds.
struct TrueState {
  Timestamp stamp;
  Pose T_world_imu;
  Vector3 v_world_imu = Vector3::Zero();
  Vector3 gyro_bias_radps = Vector3::Zero();
  bool is_sound = false;
};

std::vector<TrueState> Differentiate(const RealDrive& drive);

struct Blocks {
  double position = 0, rotation = 0, velocity = 0, gyro_bias = 0;
};

struct FeedFigures {
  Blocks nees_per_dof, rmse;
  double nis_per_dof = 0;
  double apart_m = 0;                    // largest distance between T_map_imu and T_world_imu
  double worst_velocity_mps = 0;         // largest rmse of a seed
  Vector3 accel_bias = Vector3::Zero();  // value at the end, m/s^2
  int num = 0, num_unsound = 0, num_poses = 0, num_gated = 0;
};

struct FeedSettings {
  ProcessNoise imu;
  unsigned seed = 1;
  bool believes_rotations = true;  // false: positions alone
};

// Runs the filter once over a drive, in the order of arrival, with every second true pose as an
// absolute one.
FeedFigures FeedPoses(const RealDrive& drive, const FeedSettings& settings);

}  // namespace lio::test
