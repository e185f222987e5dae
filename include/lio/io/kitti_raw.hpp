// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A KITTI raw drive (synchronised or extract release) to an LCM log, its truth and its rig.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lio/io/kitti_files.hpp"
#include "lio/io/stream_stats.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

// One OXTS packet: what is used of its 30 numbers.
struct OxtsRow {
  Timestamp stamp;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;  // 0 is east, counter-clockwise
  Vector3 v_enu_mps = Vector3::Zero();
  Vector3 f_imu_mps2 = Vector3::Zero();  // x forward, y left, z up
  Vector3 w_imu_radps = Vector3::Zero();
};

// Nothing when the text is no row of at least 25 numbers.
std::optional<OxtsRow> ParseOxts(const std::string& text);

// Poses of the IMU in east-north-up at the rows' stamps, the origin at the first: attitude as
// measured, position by integrating velocity (trapezoid).
StampedPoses OxtsPoses(const std::vector<OxtsRow>& rows);

// Samples every 1/rate_hz s from the first row's stamp on, linearly between rows; nullopt: the rows
// themselves. `rows`: stamps strictly increasing.
std::vector<ImuSample> OxtsImu(const std::vector<OxtsRow>& rows, std::optional<double> rate_hz);

// A point's instant [ns]: the head faces forward at `middle` and turns clockwise once in `turn`,
// beginning and ending behind.
std::int64_t KittiPointInstant(const LidarPoint& point, Timestamp middle, Duration turn);

struct KittiRawOptions {
  std::filesystem::path drive;
  std::filesystem::path output;
  std::optional<std::filesystem::path> truth_file;
  std::optional<std::filesystem::path> rig_file;
  std::optional<double> imu_rate_hz;
  std::function<void(double)> progress;  // share done, 0..1; may be empty
};

struct KittiRawReport {
  std::filesystem::path drive;  // the one that was found
  StreamStats lidar;
  StreamStats imu;
  AccelerometerStats accelerometer;
  std::int64_t num_points = 0;
  std::int64_t num_scans_missing = 0;  // stamped, without file
  std::int64_t num_scans_damaged = 0;
  std::int64_t num_oxts_missing = 0;
  std::int64_t num_oxts_damaged = 0;
  std::int64_t num_oxts_not_later = 0;  // stamps that do not increase; the release has some
  std::int64_t num_truth_rows = 0;
  double truth_length_m = 0.0;

  // Something was lost: exit code 5.
  bool IsDamaged() const {
    return num_scans_missing + num_scans_damaged + num_oxts_missing + num_oxts_damaged > 0;
  }
};

// Throws InputError, or std::runtime_error when an output cannot be written.
KittiRawReport ConvertKittiRaw(const KittiRawOptions& options);

std::string FormatReport(const KittiRawReport& report, const KittiRawOptions& options);

}  // namespace lio
