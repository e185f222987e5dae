// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Lidar returns as they are sent: a sweep is one turn of the sensor, a chunk is a part of one
// sweep.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/base/time.hpp"

namespace lio {

// The layout is that of the wire (docs/messages.md, point format 1), so that decoding is one copy.
struct LidarPoint {
  float x_m = 0;  // lidar frame at the point's own instant
  float y_m = 0;
  float z_m = 0;
  std::uint32_t t_offset_ns = 0;  // after the stamp of the chunk or sweep that holds the point
  std::uint16_t intensity = 0;    // 0..65535 in the sensor's own scale
  std::uint16_t ring = 0;         // 0 is the lowest beam
};
static_assert(sizeof(LidarPoint) == 20);

inline constexpr int kMaxChunkPoints = 3072;  // 61 440 bytes: one UDP datagram, no LCM fragments

struct ScanChunk {
  Timestamp stamp;               // instant of t_offset_ns = 0
  std::int32_t scan_seq = 0;     // same for all chunks of a sweep, one more for the next sweep
  std::int16_t chunk_index = 0;  // 0 .. chunk_count - 1
  std::int16_t chunk_count = 1;
  std::int8_t sensor_id = 0;
  std::vector<LidarPoint> points;
};

}  // namespace lio
