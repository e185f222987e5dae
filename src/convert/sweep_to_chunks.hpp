// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Cuts the points of one sweep into the chunks that are sent: sorted by time, of datagram size,
// each with the stamp of its own first point and the instant at which a driver would have sent it.
#pragma once

#include <span>
#include <vector>

#include "lio/sensor/scan_chunk.hpp"

namespace lio {

struct TimedSweep {
  Timestamp first;                 // the first point's instant
  Timestamp last;                  // the last point's instant
  std::vector<LidarPoint> points;  // by time, equal times in the given order; offsets from `first`
};

// `instants_ns` has one instant per point and spans at most 4 s. The points' own offsets are
// overwritten. An empty sweep stays empty.
[[nodiscard]] TimedSweep SortSweep(std::vector<LidarPoint> points,
                                   std::span<const std::int64_t> instants_ns);

struct SentChunk {
  ScanChunk chunk;
  Timestamp sent;
};

// Gives chunks of at most `max_points` points. `received` is the instant when the last point was
// in.
[[nodiscard]] std::vector<SentChunk> SplitSweep(const TimedSweep& sweep, std::int32_t scan_seq,
                                                Timestamp received,
                                                std::size_t max_points = kMaxChunkPoints);

// Converts the sensor's own intensity for the wire: rounded, clamped to 0..65535, 0 for NaN.
[[nodiscard]] std::uint16_t QuantiseIntensity(float intensity);

}  // namespace lio
