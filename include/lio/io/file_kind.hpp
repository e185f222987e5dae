// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Recognises recordings and results by their content, so that a program that is given a wrong kind
// of file can name the right command.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lio {

enum class FileKind : std::int8_t {
  kOther,
  kLcmLog,
  kRosBag,         // ROS 1 or 2 (SQLite or MCAP), a file or a folder
  kCapture,        // network capture, pcap or pcapng
  kKittiRaw,       // the folder of a drive
  kKittiOdometry,  // the folder of a sequence
  kLogFolder,      // log.lcm with config.yaml beside it, as lio-sim writes them
  kRunFolder,      // the results of lio-replay, of lio-run or of liod --out
};

[[nodiscard]] FileKind KindOf(const std::filesystem::path& path);

// Throws InputError for what is neither a regular file nor a folder: a FIFO would be waited for,
// and a device may never end. A path that does not exist passes.
void RefuseIrregular(const std::filesystem::path& path);

// Returns the steady path in a run's folder: trajectory_level.tum, or trajectory.tum without
// gravity.
[[nodiscard]] std::filesystem::path PathOfRun(const std::filesystem::path& folder);

// Returns one line that says what `path` is and which command takes it; empty for logs and for
// kOther.
[[nodiscard]] std::string WhyNoLog(const std::filesystem::path& path);
// Returns the same for what is no trajectory; empty for kOther.
[[nodiscard]] std::string WhyNoTrajectory(const std::filesystem::path& path);
// Returns the same for what need not be converted; empty for all but logs and results.
[[nodiscard]] std::string WhyNoRecording(const std::filesystem::path& path);

}  // namespace lio
