// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The extrinsic between lidar and IMU is corrected while driving. Matching measures the lidar; with
// another extrinsic the same match puts another body into the map:
//   T_map_imu' = T_map_imu T_old_new,   T_old_new = T_old_lidar T_new_lidar^-1,
// and that body's velocity is v' = R_old_new^T (v + w x t_old_new), in imu.
// The path in world goes on without a jump or a bend: the body's position stays, and its yaw takes
// the yaw of the correction, as it does in the map. Its roll and pitch stay, for gravity shows
// them; the map is tilted in the world instead. Biases, tilt and velocity were bent by the
// contradiction, and are forgotten.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

struct ExtrinsicCorrectionParameters {
  // 1 sigma of roll and pitch after the correction: an extrinsic that is wrong by some degrees
  // tilts the world by as much. Chosen; gravity shows it again within seconds.
  double tilt_std_rad = 0.05;
  // 1 sigma of the velocity, m/s: 5 deg at 10 m/s. Chosen; two scans show it again.
  double velocity_std_mps = 1.0;
};

inline constexpr ExtrinsicCorrectionParameters kExtrinsicCorrection;

// Holds the standard deviations of biases that are forgotten: those before anything is known.
struct BiasStds {
  double gyro_radps = 0.0;
  double accel_mps2 = 0.0;
};

// `w_imu_radps`: the rate, bias-corrected, at the estimate's stamp, in imu so far. Correlations
// between position, rotation, velocity, biases and map pose are gone. The map's start is marked
// anew (map_bend.hpp).
void CorrectExtrinsic(const Pose& T_old_new, const Vector3& w_imu_radps, const BiasStds& bias_stds,
                      Estimate& estimate);

}  // namespace lio
