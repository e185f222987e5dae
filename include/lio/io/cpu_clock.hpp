// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the clock for the stage times of the estimator.
#pragma once

#include <cstdint>
#include <ctime>

namespace lio {

// Returns the CPU time of the calling thread. One call takes about 0.3 us, the time of a system
// call.
[[nodiscard]] inline std::int64_t ThreadCpuNs() {
  std::timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace lio
