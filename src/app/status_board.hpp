// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Where the threads pin what LIO_STATUS will say.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "lio/io/status_report.hpp"

namespace lio {

class StatusBoard {
 public:
  StatusBoard(std::uint64_t config_hash, std::int32_t receive_buffer_bytes);

  void SetEstimator(const Counters& counters, TrackingStatus state, Timestamp newest_stamp);
  void SetInput(const InputCounters& counters);
  void SetNote(std::string note);
  void CountRefusedCommand();
  // Of one scan: from the arrival of its last datagram to the start of its match, and from there to
  // its odometry.
  void AddLatency(double queue_ms, double compute_ms);

  InputCounters input() const;

  // All of the above and what this process uses; the latencies, and the time that the load is
  // measured over, start anew.
  StatusReport Compose();

 private:
  struct Latencies {
    std::vector<float> queue_ms, compute_ms, total_ms;
  };

  mutable std::mutex mutex_;  // guards everything below
  StatusReport report_;
  Latencies latencies_;
  std::int64_t last_utime_;
  std::int64_t last_cpu_us_;
};

// Host's clock, us since the epoch.
std::int64_t HostUtime();

}  // namespace lio
