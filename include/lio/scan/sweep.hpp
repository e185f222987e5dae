// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// One turn of the lidar, put together from its chunks.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/sensor/scan_chunk.hpp"

namespace lio {

struct Sweep {
  Timestamp start;  // instant of t_offset_ns = 0: the first point's stamp
  Timestamp end;    // the last point's stamp; the instant that poses of this sweep are for
  std::int32_t scan_seq = 0;
  int num_missing_chunks = 0;
  std::int64_t decode_ns = 0;      // CPU time its messages took to decode
  std::vector<LidarPoint> points;  // in the order of the chunks, offsets from `start`
};

}  // namespace lio
