// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The file formats that KITTI's raw drives and odometry sequences share.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

// "2011-09-26 13:04:32.335337762" on a clock without time zone, taken as UTC.
std::optional<Timestamp> ParseKittiStamp(std::string_view line);

// A file of such lines. Throws InputError naming file and line.
std::vector<Timestamp> ReadKittiStamps(const std::filesystem::path& file);

// Numbers behind "key:", e.g. of calib_imu_to_velo.txt; words that are no numbers end a row. Throws
// InputError when the file cannot be read.
std::map<std::string, std::vector<double>> ReadKittiCalibration(const std::filesystem::path& file);

// The rotation nearest to nine numbers and the translation. Throws InputError naming `what` when
// the numbers are no rigid motion.
Pose ToPose(const std::vector<double>& rotation_row_major, const std::vector<double>& translation,
            const std::string& what);

// A scan of "x y z reflectance" as float32 (.bin) or text (.txt, the unsynchronised release).
// Points carry intensity 0..255 and rings counted from below, found from the order of the points:
// ring by ring, the highest first, each from azimuth 0 up and round. Offsets are 0. Nothing when
// the file is missing, no multiple of a point, or holds no finite point.
std::optional<std::vector<LidarPoint>> ReadKittiScan(const std::filesystem::path& file);

// Azimuth of each step between rings in a row of points, made visible for tests: ring 63 first.
void AssignKittiRings(std::vector<LidarPoint>& points);

// Data files of a folder by their number ("0000000012.bin" is 12), ascending.
std::map<int, std::filesystem::path> NumberedFiles(const std::filesystem::path& folder);

}  // namespace lio
