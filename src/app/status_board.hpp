// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Collects from all threads what LIO_STATUS reports. Any thread may call any function.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "lio/io/host_clock.hpp"
#include "lio/io/status_report.hpp"

namespace lio {

// Returns the CPU time that this process has used, all threads together, us.
[[nodiscard]] std::int64_t ProcessCpuMicroseconds();

// Holds the clocks that the status is made with.
struct StatusClocks {
  std::function<std::int64_t()> host_utime = HostUtime;
  std::function<std::int64_t()> process_cpu_us = ProcessCpuMicroseconds;
};

class StatusBoard {
 public:
  // `options` are the effective ones as YAML. `configured_offset_s` is rig.lidar.clock_offset_s,
  // which holds until there is an estimate.
  StatusBoard(std::string options, std::int32_t receive_buffer_bytes,
              double configured_offset_s = 0.0, StatusClocks clocks = {});

  // The ledgers of the counters are with what waits.
  void SetEstimator(const Counters& counters, TrackingStatus state, Timestamp newest_stamp);
  void SetImuNoise(const ImuNoiseRatios& ratios);
  void SetClockOffset(const ClockOffsetStatus& offset);
  void ForgetClockOffset();  // back to the configured one
  void SetTrust(Trust trust);
  void SetInput(const InputCounters& counters);
  void SetNote(std::string note);
  // Stands in place of all notes from now on, because it does not pass.
  void SetAlarm(std::string alarm);
  // The next report has the options, as the first has.
  void TellOptions();
  void CountRefusedCommand();
  // Adds the times of one scan: `queue_ms` from the arrival of its last datagram to the start of
  // its match, `compute_ms` from there to its odometry.
  void AddLatency(double queue_ms, double compute_ms);

  [[nodiscard]] InputCounters input() const;
  // Returns when the board was made, as the status tells it.
  [[nodiscard]] std::int64_t start_utime() const;

  // Returns everything above, with the memory and the CPU time that this process uses. The
  // latencies and the load are those since the Compose before.
  [[nodiscard]] StatusReport Compose();

 private:
  struct Latencies {
    std::vector<float> queue_ms, compute_ms, total_ms;
  };

  const StatusClocks clocks_;
  const std::string options_;
  const double configured_offset_s_;
  mutable std::mutex mutex_;  // guards everything below
  StatusReport report_;
  std::string alarm_;
  bool tells_options_ = true;
  Latencies latencies_;
  std::int64_t last_utime_;
  std::int64_t last_cpu_us_;
};

}  // namespace lio
