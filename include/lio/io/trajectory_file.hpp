// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads and writes trajectories as text. A row of TUM is "t x y z qx qy qz qw" with t in seconds; a
// row of KITTI is the upper 3x4 of a pose matrix, row-major, without stamp. Stamps are read and
// written as decimal integers, never through a double, so that nanoseconds survive.
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

// Reads either format; the number of columns of the first row, 8 or 12, tells them apart. Columns
// are separated by blanks. Empty lines and lines that start with # are skipped. Small rounding
// errors of a rotation are normalised away.
//
// Throws std::runtime_error "FILE:LINE: message", with the column when one is at fault, for a
// different number of columns, a word that is not a finite number, a stamp that is not above the
// one before, and a quaternion or matrix that is not a rotation; and "FILE: message" when the file
// cannot be read or holds no pose. A last row without a line feed that cannot be read is what a
// killed program leaves: it is left out, and TellCutLine says so.
[[nodiscard]] Trajectory ReadTrajectory(const std::filesystem::path& file);
// Tells on stderr that the last line of the file was left out.
void TellCutLine(const std::filesystem::path& file);

// Both overwrite an existing file, and throw std::runtime_error naming the file when it cannot be
// written.
void WriteTum(const std::filesystem::path& file, const StampedPoses& poses);
void WriteKitti(const std::filesystem::path& file, const StampedPoses& poses);

// Returns one row without line end; all numbers have 9 decimals.
[[nodiscard]] std::string TumRow(const StampedPose& pose);

// Returns the stamp in seconds with 9 decimals, exact.
[[nodiscard]] std::string StampText(Timestamp stamp);

// Parses decimal seconds, also in exponent form, and rounds to the nearest nanosecond. Gives
// nothing for any other text and for a stamp beyond kMaxStamp_ns (base/stamp_limit.hpp).
[[nodiscard]] std::optional<Timestamp> ParseStamp(std::string_view text);

}  // namespace lio
