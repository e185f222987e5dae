// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How many messages a second a channel had lately.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

namespace lio {

class RateMeter {
 public:
  static constexpr std::int64_t kWindow_us = 3'000'000;
  static constexpr std::size_t kMaxMessages = 10'000;  // bounds memory, and rates at 3 kHz

  void Add(std::int64_t utime);
  // Returns the rate over the window before `now_utime`, in messages a second. The window is
  // shorter when the first message is younger, and a rate needs two messages.
  [[nodiscard]] double RateHz(std::int64_t now_utime) const;
  void Clear() { *this = {}; }

 private:
  std::deque<std::int64_t> utimes_;
};

}  // namespace lio
