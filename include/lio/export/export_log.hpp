// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Takes liod's messages out of an LCM log, into files that other programs open.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "lio/io/input_decoder.hpp"

namespace lio {

enum class McapCompression { kNone, kLz4, kZstd };

struct ExportOptions {
  std::string channel_prefix = kDefaultChannelPrefix;
  bool with_inputs = false;  // MCAP: the inertial samples and the sweeps as they came, too
  McapCompression compression = McapCompression::kZstd;
  std::function<void(std::int64_t at_bytes, std::int64_t of_bytes)> progress;
};

struct ExportCounts {
  std::int64_t num_messages = 0;   // written to the export
  std::int64_t num_refused = 0;    // malformed ones on the same channels
  std::int64_t num_points = 0;     // PLY
  std::int64_t skipped_bytes = 0;  // damage of the log
};

// Writes an MCAP file with Foxglove's well-known types in JSON (docs/export.md has the topics),
// which Foxglove and Lichtblick open as it is. These four throw InputError where the log has
// nothing of it, OutputError and WriteError as OutputFile does.
ExportCounts ExportMcap(const std::filesystem::path& log, const std::filesystem::path& file,
                        const ExportOptions& options);

// Writes a table for each kind of message, in a folder that is made: odometry.csv,
// odometry_imu.csv, state.csv, registration.csv, status.csv. Tables without a row are not written.
ExportCounts ExportCsv(const std::filesystem::path& log, const std::filesystem::path& folder,
                       const ExportOptions& options);

// Writes the points of all registered clouds, the first one in each voxel of 0.2 m.
ExportCounts ExportPly(const std::filesystem::path& log, const std::filesystem::path& file,
                       const ExportOptions& options);

// Writes the path in world, as LIO_ODOM has it.
ExportCounts ExportTum(const std::filesystem::path& log, const std::filesystem::path& file,
                       const ExportOptions& options);

}  // namespace lio
