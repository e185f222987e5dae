// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the daemon's report on LIO_STATUS.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lio/io/account.hpp"
#include "lio/pipeline/outputs.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

// Latencies of the scans of one second; all zero when there were none.
struct LatencySummary {
  float p50_ms = 0.0F;
  float p99_ms = 0.0F;
  float max_ms = 0.0F;
};

// To be added to the lidar's stamps, rig.lidar.clock_offset_s included. The standard deviation is
// zero where the offset is configured and not estimated.
struct ClockOffsetStatus {
  double offset_s = 0.0;
  double std_s = 0.0;
};

struct StatusReport {
  std::int64_t utime = 0;        // us since the epoch, host's clock
  std::int64_t start_utime = 0;  // when the daemon started, host's clock
  Timestamp newest_stamp;        // sensor time of the newest accepted message
  std::int32_t seq = 0;
  TrackingStatus state = TrackingStatus::kInit;
  Counters counters;
  InputCounters input;
  std::int64_t num_imu_queue_dropped = 0;
  std::int64_t num_chunk_queue_dropped = 0;
  std::int64_t num_kernel_dropped = -1;  // -1: unknown
  std::int64_t num_publish_failed = 0;
  std::int64_t num_outputs_dropped = 0;
  std::int64_t num_commands_refused = 0;
  std::int64_t num_handler_faults = 0;
  std::vector<AccountPage> account = AccountPages({}, {});
  std::int32_t receive_buffer_bytes = 0;  // 0: unknown
  LatencySummary queue;                   // arrival of a scan's last datagram to start of its match
  LatencySummary compute;                 // from there to its odometry
  LatencySummary latency;                 // both
  float cpu_load_cores = 0.0F;            // over the last second
  float rss_mb = 0.0F;
  float map_mb = 0.0F;
  ImuNoiseRatios imu_noise;
  ClockOffsetStatus clock_offset;
  Trust trust = Trust::kYes;  // at the last look
  std::uint64_t config_hash = 0;
  std::string note;     // the last notice
  std::string options;  // the effective ones as YAML, or empty
};

// Longer texts of a status are refused by its decoder: the longest notice has some hundred bytes,
// and all options have 11 kB.
inline constexpr std::size_t kMaxStatusText = std::size_t{1} << 16;

// `version` reads "major.minor.patch".
[[nodiscard]] Bytes EncodeStatus(const StatusReport& report, const std::string& version);

// Returns the 64-bit FNV-1a hash of a text, e.g. of the printed options
// (http://www.isthe.com/chongo/tech/comp/fnv).
[[nodiscard]] std::uint64_t Fnv1a(std::string_view text);

}  // namespace lio
