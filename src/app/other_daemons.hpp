// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells whether another liod publishes on the channels of this one: its status has another start.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "lio/io/lcm_codec.hpp"

namespace lio {

class OtherDaemons {
 public:
  // Messages of others since the start. One alone, which may be false, counts as none.
  struct Heard {
    std::int64_t num = 0;
    std::int64_t start_utime = 0;  // the start of the last one
  };

  explicit OtherDaemons(std::int64_t own_start_utime) : own_start_utime_(own_start_utime) {
    starts_.fill(own_start_utime);
  }

  // Takes a message of LIO_STATUS, also one of this daemon, or whatever bytes came there.
  void Hear(ByteView bytes);
  // Any thread may call it.
  [[nodiscard]] Heard heard() const;

 private:
  [[nodiscard]] bool IsKnown(std::int64_t start_utime);

  const std::int64_t own_start_utime_;
  std::array<std::int64_t, 8> starts_{};  // chosen: of more daemons than anybody starts by mistake
  std::size_t next_ = 0;                  // place in `starts_`
  mutable std::mutex mutex_;              // guards heard_
  Heard heard_;
};

}  // namespace lio
