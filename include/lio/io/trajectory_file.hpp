// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Trajectories as text. TUM: "t x y z qx qy qz qw" a row, t in seconds; KITTI: the upper 3x4 of a
// pose matrix a row, row-major, no stamps. Stamps are read and written as decimal integers, never
// through a double: nanoseconds survive.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "lio/sensor/stamped_pose.hpp"

namespace lio {

enum class TrajectoryFormat { kTum, kKitti };

struct Trajectory {
  TrajectoryFormat format = TrajectoryFormat::kTum;
  StampedPoses poses;  // kKitti: stamp.ns is the row's index, 0 first
};

// Reads either format, told apart by the first row's columns (8 or 12, separated by blanks). Empty
// lines and lines that start with # are passed over. Strict: throws std::runtime_error
// "FILE:LINE: message", with the column where one is at fault, for a column count that differs, a
// word that is no finite number, a stamp not above the one before, a quaternion or matrix that is
// no rotation (small rounding is normalised away), and "FILE: message" when the file cannot be read
// or holds no pose.
Trajectory ReadTrajectory(const std::filesystem::path& file);

// Overwrite; throw std::runtime_error naming the file when it cannot be written.
void WriteTum(const std::filesystem::path& file, const StampedPoses& poses);
void WriteKitti(const std::filesystem::path& file, const StampedPoses& poses);

// One row without line end: the stamp with 9 decimals, then 9 decimals each.
std::string TumRow(const StampedPose& pose);

// Seconds with 9 decimals, exact.
std::string StampText(Timestamp stamp);

// Decimal seconds, also in exponent form, rounded to the nearest nanosecond; empty for anything
// else and for what 64 bits of nanoseconds cannot hold.
std::optional<Timestamp> ParseStamp(std::string_view text);

}  // namespace lio
