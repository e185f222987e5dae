// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the description of an Ouster sensor, a JSON file that its driver saves beside a capture,
// without which its packets cannot be read: the beams' angles, and how a packet is laid out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "lio/base/pose.hpp"

namespace lio {

// Lengths are in mm, here and in packets.
inline constexpr double kMetresPerMillimetre = 1e-3;
inline constexpr std::size_t kOusterPixelBytes = 12;  // one beam in a packet

enum class OusterProfile { kLegacy, kRng19 };

struct OusterMetadata {
  OusterProfile profile = OusterProfile::kLegacy;
  std::size_t columns_per_turn = 1024;
  std::size_t columns_per_packet = 16;
  std::vector<double> elevation_rad;       // one a beam, as the packet lists them
  std::vector<double> azimuth_offset_rad;  // clockwise
  double beam_origin_m = 0.0;              // from the axis to where the beams leave
  Pose T_sensor_lidar;                     // the sensor's frame looks where its plug is not
  Pose T_sensor_imu;

  [[nodiscard]] std::size_t PacketBytes() const;
};

// Reads old files, which are flat, and new ones, which are nested. Throws InputError that names the
// file and what is missing, or a profile that is not supported.
[[nodiscard]] OusterMetadata ReadOusterMetadata(const std::filesystem::path& file);

}  // namespace lio
