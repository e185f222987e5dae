// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the file formats that KITTI's raw drives and odometry sequences share.
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

// Parses "2011-09-26 13:04:32.335337762", a time without time zone that is taken as UTC.
[[nodiscard]] std::optional<Timestamp> ParseKittiStamp(std::string_view line);

// Reads a file of such lines. Throws InputError that names file and line.
[[nodiscard]] std::vector<Timestamp> ReadKittiStamps(const std::filesystem::path& file);

// Reads the numbers behind each "key:", e.g. of calib_imu_to_velo.txt; a word that is no number
// ends the row. Throws InputError when the file cannot be read.
[[nodiscard]] std::map<std::string, std::vector<double>> ReadKittiCalibration(
    const std::filesystem::path& file);

// Returns the rotation nearest to nine numbers and the translation. Throws InputError that names
// `what` when the numbers are no rigid motion.
[[nodiscard]] Pose ToPose(const std::vector<double>& rotation_row_major,
                          const std::vector<double>& translation, const std::string& what);

// Reads a scan of "x y z reflectance" as float32 (.bin) or text (.txt, the unsynchronised release).
// Points get intensity 0..255 and rings counted from below. The rings are found from the order of
// the points: they are stored ring by ring, the highest first, each from azimuth 0 upward and
// around. Offsets are 0. Returns nothing when the file is missing, has a size that is no multiple
// of a point, or holds no finite point.
[[nodiscard]] std::optional<std::vector<LidarPoint>> ReadKittiScan(
    const std::filesystem::path& file);

// Assigns rings, 63 first, by the steps in azimuth between rings in a row of points; public for
// tests.
void AssignKittiRings(std::vector<LidarPoint>& points);

// Returns the absolute path of a folder without a slash at its end, so that its parents have names.
[[nodiscard]] std::filesystem::path WholePath(const std::filesystem::path& folder);

// Returns the data files of a folder by their number ("0000000012.bin" is 12), ascending.
[[nodiscard]] std::map<int, std::filesystem::path> NumberedFiles(
    const std::filesystem::path& folder);

}  // namespace lio
