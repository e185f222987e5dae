// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads a log and hands each message of liod's to the function for its kind. Kinds without a
// function are passed over; malformed messages are counted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "lio/export/export_log.hpp"
#include "lio/io/output_decoder.hpp"

namespace lio {

// Times of reception are those of the log; a stamp that no clock shows is 0.
struct OutputTakers {
  std::function<void(const NavOutput&, Timestamp received)> odometry;
  std::function<void(const NavOutput&, Timestamp received)> odometry_imu;
  std::function<void(const FilterReport&, Timestamp received)> state;
  std::function<void(const ScanReport&, Timestamp received)> registration;
  std::function<void(const StatusReport&, Timestamp received)> status;
  std::function<void(const ScanChunk&, Timestamp received)> cloud;  // registered, of both channels
  std::function<void(const ImuSample&, Timestamp received)> imu;    // inputs
  std::function<void(const ScanChunk&, Timestamp received)> scan;
};

// Throws InputError naming the log when it cannot be read, or when it has no message for the
// takers.
ExportCounts ReadOutputs(const std::filesystem::path& log, const ExportOptions& options,
                         const OutputTakers& takers);

}  // namespace lio
