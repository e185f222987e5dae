// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Converts a KITTI raw drive (synchronised or extract release) to an LCM log, its truth and its
// rig.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lio/convert/kitti_files.hpp"
#include "lio/convert/oxts.hpp"
#include "lio/io/stream_stats.hpp"

namespace lio {

// Returns a point's instant [ns]: the head faces forward at `middle` and makes one clockwise turn
// in `turn`, which begins and ends facing backward.
[[nodiscard]] std::int64_t KittiPointInstant(const LidarPoint& point, Timestamp middle,
                                             Duration turn);

struct KittiRawOptions {
  std::filesystem::path drive;
  std::filesystem::path output;
  std::optional<std::filesystem::path> truth_file;
  std::optional<std::filesystem::path> rig_file;
  std::optional<double> imu_rate_hz;
  std::function<void(double)> progress;  // called with the share done, 0..1; may be empty
};

struct KittiRawReport {
  std::filesystem::path drive;  // the drive that was found
  StreamStats lidar;
  StreamStats imu;
  AccelerometerStats accelerometer;
  std::int64_t num_points = 0;
  std::int64_t num_scans_missing = 0;  // scans that have a stamp but no file
  std::int64_t num_scans_damaged = 0;
  std::int64_t num_oxts_missing = 0;
  std::int64_t num_oxts_damaged = 0;
  std::int64_t num_oxts_not_later =
      0;  // packets whose stamps do not increase; the release has some
  std::int64_t num_truth_rows = 0;
  double truth_length_m = 0.0;

  // Returns true when something was lost, which means exit code 5.
  [[nodiscard]] bool IsDamaged() const {
    return num_scans_missing + num_scans_damaged + num_oxts_missing + num_oxts_damaged > 0;
  }
};

// Returns the files and folders that ConvertKittiRaw reads.
[[nodiscard]] std::vector<std::filesystem::path> InputsOf(const KittiRawOptions& options);

// Throws InputError, or std::runtime_error when an output cannot be written.
[[nodiscard]] KittiRawReport ConvertKittiRaw(const KittiRawOptions& options);

[[nodiscard]] std::string FormatReport(const KittiRawReport& report,
                                       const KittiRawOptions& options);

}  // namespace lio
