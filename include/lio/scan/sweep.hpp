// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds one turn of the lidar, assembled from its chunks. Points are in the lidar frame at their
// own instants.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lio/sensor/scan_chunk.hpp"

namespace lio {

struct SweepParameters {
  // Longer sweeps are wrong stamps. Chosen: no lidar turns slower than twice a second; data sheets
  // end at five.
  Duration max_span{500'000'000};
};
inline constexpr SweepParameters kSweep;

struct Sweep {
  Timestamp start;            // instant of t_offset_ns = 0: the first point's stamp
  Timestamp end;              // the last point's stamp
  Duration clock_correction;  // in both stamps, by the estimated clock offset
  std::int32_t scan_seq = 0;
  int num_missing_chunks = 0;
  double share_before = 0.0;       // share of the turn's chunks before the first that came
  std::int64_t decode_ns = 0;      // CPU time of decoding its messages
  std::vector<LidarPoint> points;  // in the order of the chunks, offsets from `start`

  // Returns the instant for which matching measures the pose. Motion errors within the sweep then
  // act over half a sweep to either side; with the end as reference their variance would be four
  // times as large and correlated with the filter's process noise (docs/filter.md, Covariance of a
  // match).
  Timestamp middle() const { return start + Duration{(end - start).ns / 2}; }

  // Adds to both stamps.
  void MoveBy(Duration correction) {
    start = start + correction;
    end = end + correction;
    clock_correction = clock_correction + correction;
  }
};

using SweepPtr = std::shared_ptr<const Sweep>;

}  // namespace lio
