// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The host's clock, for measuring latency and nothing else: no estimate asks it.
#pragma once

#include <chrono>
#include <cstdint>

namespace lio {

// Returns microseconds since the epoch.
[[nodiscard]] inline std::int64_t HostUtime() {
  using std::chrono::microseconds;
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<microseconds>(since_epoch).count();
}

}  // namespace lio
