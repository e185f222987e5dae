// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/ordered_log.hpp"

#include <algorithm>

namespace lio {

void OrderedLog::Add(Timestamp event, std::string_view channel, Bytes data) {
  std::int64_t utime = event.Microseconds();
  if (utime < last_written_) {
    ++num_late_;
    utime = last_written_;
  }
  held_.emplace(utime, Event{channel, std::move(data)});
  ++num_events_;
  newest_ = std::max(newest_, utime);
  WriteUpTo(newest_ - kHold.ns / 1000);
}

void OrderedLog::Close() {
  WriteUpTo(INT64_MAX);
  writer_.Close();
}

void OrderedLog::WriteUpTo(std::int64_t utime) {
  const auto end = held_.upper_bound(utime);
  for (auto it = held_.begin(); it != end; ++it) {
    writer_.Write(it->first, it->second.channel, it->second.data);
    last_written_ = it->first;
  }
  held_.erase(held_.begin(), end);
}

}  // namespace lio
