// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads KITTI's OXTS packets (GNSS/INS): the IMU stream and the reference poses of a raw drive.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

// Holds those of the 30 numbers of an OXTS packet that are used.
struct OxtsRow {
  Timestamp stamp;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;  // 0 is east, counter-clockwise
  Vector3 v_enu_mps = Vector3::Zero();
  Vector3 f_imu_mps2 = Vector3::Zero();  // x forward, y left, z up
  Vector3 w_imu_radps = Vector3::Zero();
};

// Returns nothing when the text is no row of at least 25 numbers.
[[nodiscard]] std::optional<OxtsRow> ParseOxts(const std::string& text);

// Returns the poses of the IMU at the rows' stamps, in an east-north-up frame with its origin at
// the first: attitude as measured, position by integrating velocity (trapezoid).
[[nodiscard]] StampedPoses OxtsPoses(const std::vector<OxtsRow>& rows);

// Returns samples every 1/rate_hz s from the first row's stamp on, interpolated linearly between
// rows; without a rate, the rows themselves. The stamps of `rows` must strictly increase.
[[nodiscard]] std::vector<ImuSample> OxtsImu(const std::vector<OxtsRow>& rows,
                                             std::optional<double> rate_hz);

}  // namespace lio
