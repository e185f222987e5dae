// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Counts of everything that was lost, refused or odd, which are zero on a clean log, and of what
// was taken in: samples, chunks, scans and standstills.
#pragma once

#include <cstdint>

#include "lio/base/ledger.hpp"

namespace lio {

struct Counters {
  std::int64_t num_imu = 0;
  std::int64_t num_imu_nonfinite = 0;
  std::int64_t num_imu_duplicate = 0;
  std::int64_t num_imu_late = 0;  // stamped before what was already fused
  std::int64_t num_imu_out_of_range = 0;
  std::int64_t num_imu_clipped = 0;  // an axis at the end of its range
  std::int64_t num_imu_gaps = 0;
  std::int64_t num_imu_stuck = 0;  // times that the IMU was left since an axis had stopped ...
  std::int64_t num_imu_contradicted = 0;  // ... or since it contradicted the scans
  std::int64_t num_chunks = 0;
  std::int64_t num_chunks_duplicate = 0;
  std::int64_t num_chunks_late = 0;
  std::int64_t num_chunks_missing = 0;
  std::int64_t num_chunks_bad = 0;  // inconsistent index, count or time span
  std::int64_t num_points_nonfinite = 0;
  std::int64_t num_scans = 0;  // sweeps closed, empty ones included
  std::int64_t num_scans_empty = 0;
  std::int64_t num_scans_dropped = 0;  // overload, live only
  std::int64_t num_scans_late = 0;
  std::int64_t num_scans_without_imu = 0;
  std::int64_t num_scan_gaps = 0;
  std::int64_t num_scans_repeated = 0;  // the points of the scan before, while the body moved
  std::int64_t num_matches_rejected = 0;
  std::int64_t num_gated = 0;
  std::int64_t num_standstills = 0;  // scans taken at rest, and fused as such
  std::int64_t num_clock_jumps = 0;
  std::int64_t num_restarts = 0;
  std::int64_t num_lost = 0;            // restarts where scans had matched the map nowhere
  std::int64_t num_imu_foreign = 0;     // from a second sender on the channel
  std::int64_t num_chunks_foreign = 0;  // likewise

  Ledgers ledgers;  // without what waits
};

}  // namespace lio
