// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Keeps when the last scans arrived and when their matches began, by the host's clock: for the
// latencies of LIO_STATUS. Scans are found by their sequence number.
#pragma once

#include <array>
#include <cstdint>

namespace lio {

struct ScanTiming {
  std::int32_t scan_seq = -1;
  std::int64_t arrived_utime = 0;  // us since the epoch, of its last chunk; 0: unknown
  std::int64_t started_utime = 0;  // when its match began; 0: not begun

  [[nodiscard]] bool is_complete() const { return arrived_utime != 0 && started_utime != 0; }
};

class ScanTimings {
 public:
  static constexpr std::size_t kMaxScans = 64;  // older ones are forgotten

  // Returns the timing of the scan, empty when it is new.
  [[nodiscard]] ScanTiming& Of(std::int32_t scan_seq) {
    ScanTiming& timing = timings_[static_cast<std::uint32_t>(scan_seq) % kMaxScans];
    if (timing.scan_seq != scan_seq) timing = {scan_seq, 0, 0};
    return timing;
  }

 private:
  std::array<ScanTiming, kMaxScans> timings_;
};

}  // namespace lio
