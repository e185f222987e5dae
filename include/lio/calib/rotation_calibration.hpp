// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Calibrates clock offset and relative rotation of lidar and IMU from the turns that both measured.
//
// Does: searches the offset at which the turn rates agree best, with rotation and gyro bias in
// closed form at each (rate_search.hpp); then fits offset, rotation and bias by least squares
// (Ceres) to the turns between neighbouring sweeps against preintegrated rates (turn_fit.hpp).
// Model: imu clock = lidar clock + offset. R_map_lidar of a sweep has a small rotation error of its
// own, which the turns before and after it share with opposite signs; a turn also errs by gyro
// noise and the map's drift. Both standard deviations are estimated from the residuals. Output:
// estimates with covariance, scaled up when residuals are larger than the model expects. Failure:
// no result but a reason when lidar and gyro do not agree, a result with a reason when the motion
// does not determine everything. Nothing throws. A minute at 10 Hz and 100 Hz costs about 0.3 s.
// Sources: rotation from vectors: Kabsch, Acta Cryst. 1976 (Wahba's problem); preintegration:
// Forster et al., TRO 2017. Method and figures: docs/calibration.md; constants:
// calibration_parameters.hpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/base/angle.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

// Holds the lidar's attitude by scan matching at the middle of a sweep, in a map that does not
// move.
struct SweepRotation {
  Timestamp stamp;  // by the lidar's clock
  Quaternion R_map_lidar = Quaternion::Identity();
};

struct RotationCalibrationOptions {
  double max_offset_s = 0.5;  // the search covers +- this; chosen: more takes longer
  // A result with larger standard deviations is not sure: the motion does not determine it. Chosen:
  // 24 times and 5 times those of 40 s of a walk (docs/calibration.md, Figures).
  double max_offset_std_s = 1e-3;
  double max_rotation_std_rad = 0.2 * kRadPerDeg;
};

struct RotationCalibration {
  double offset_s = 0.0;  // imu clock = lidar clock + offset
  double offset_std_s = 0.0;
  Quaternion R_imu_lidar = Quaternion::Identity();
  Matrix3 rotation_cov = Matrix3::Zero();  // right error of R_imu_lidar, rad^2, lidar axes
  Vector3 gyro_bias_radps = Vector3::Zero();
  Vector3 gyro_bias_std_radps = Vector3::Zero();
  double sweep_std_rad = 0.0;        // error of a sweep's rotation, per axis
  double turn_std_rad = 0.0;         // further error of a turn, per axis
  double residual_ratio = 0.0;       // root of the normalized mean squared residual; about 1
  double correlation = 0.0;          // between the turn rates, at the offset of the search, 0..1
  double turn_rate_rms_radps = 0.0;  // root mean square about the mean
  int num_turns = 0;
};

struct RotationCalibrationResult {
  std::optional<RotationCalibration> found;  // sure or not
  std::string why_not;  // why nothing was found or is not sure, with the remedy; empty when sure

  [[nodiscard]] bool is_sure() const { return found && why_not.empty(); }
};

// `samples` and `sweeps` ascend in time, each by its own clock. Turns across a missing sweep or
// missing samples are left out.
[[nodiscard]] RotationCalibrationResult CalibrateRotation(
    std::span<const ImuSample> samples, std::span<const SweepRotation> sweeps,
    const RotationCalibrationOptions& options = {});

}  // namespace lio
