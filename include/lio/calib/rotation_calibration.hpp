// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Clock offset and relative rotation of lidar and IMU, from the turns that both have seen.
//
// Does: a search over offsets for the best agreement of turn rates, rotation and gyro bias in
// closed form at each (rate_search.hpp); then least squares (Ceres) of offset, rotation and bias on
// the turns between neighbouring sweeps against preintegrated rates. Model: lidar clock + offset =
// imu clock; R_map_lidar of a sweep is right up to a small rotation of its own, which the turns
// before and after it share with opposite signs; a turn errs by gyro noise and the map's drift
// besides. Both sizes are taken from the residuals. Output: with covariance, widened when residuals
// are larger than the model has it. Absent with a reason when the two do not agree, or when the
// motion does not show all of it. Cost: about 0.3 s for a minute at 10 Hz and 100 Hz. Sources:
// rotation from vectors: Kabsch, Acta Cryst. 1976; Wahba's problem. Preintegration: Forster et al.,
// TRO 2017. docs/calibration.md.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/sensor/imu_sample.hpp"

namespace lio {

// What scan matching found for the middle of a sweep; the map does not move.
struct SweepRotation {
  Timestamp stamp;  // of the lidar's clock
  Quaternion R_map_lidar = Quaternion::Identity();
};

struct RotationCalibrationOptions {
  double max_offset_s = 0.5;
  // Beyond these standard deviations a result is refused as not shown by the motion.
  double max_offset_std_s = 1e-3;
  double max_rotation_std_rad = 0.2 * 0.017453292519943295;
};

struct RotationCalibration {
  double offset_s = 0.0;  // imu clock = lidar clock + offset
  double offset_std_s = 0.0;
  Quaternion R_imu_lidar = Quaternion::Identity();
  Matrix3 rotation_cov = Matrix3::Zero();  // right error of R_imu_lidar: about the lidar's axes
  Vector3 gyro_bias_radps = Vector3::Zero();
  Vector3 gyro_bias_std_radps = Vector3::Zero();
  double sweep_std_rad = 0.0;  // of one sweep's rotation, per axis
  double turn_std_rad = 0.0;   // what a turn errs besides, per axis
  double misfit = 0.0;         // residuals over what is expected, as a standard deviation; about 1
  double correlation = 0.0;    // of the turn rates at the offset found by the search; 1: all agree
  double turn_rate_rms_radps = 0.0;  // how lively the motion was
  int num_turns = 0;
};

struct RotationCalibrationResult {
  std::optional<RotationCalibration> found;
  std::string why_not;  // says what to do
};

// Both ascend in time. Turns across a missing sweep or missing samples are left out.
RotationCalibrationResult CalibrateRotation(std::span<const ImuSample> samples,
                                            std::span<const SweepRotation> sweeps,
                                            const RotationCalibrationOptions& options = {});

}  // namespace lio
