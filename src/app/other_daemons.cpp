// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/other_daemons.hpp"

#include <algorithm>

#include "lio/io/output_account.hpp"

namespace lio {

bool OtherDaemons::IsKnown(std::int64_t start_utime) {
  if (std::find(starts_.begin(), starts_.end(), start_utime) != starts_.end()) return true;
  starts_.at(next_) = start_utime;
  next_ = (next_ + 1) % starts_.size();
  return false;
}

void OtherDaemons::Hear(ByteView bytes) {
  const auto status = DecodeStatusCounts(bytes);
  if (!status || status->start_utime == own_start_utime_) return;
  if (!IsKnown(status->start_utime)) return;
  const std::lock_guard lock(mutex_);
  ++heard_.num;
  heard_.start_utime = status->start_utime;
}

OtherDaemons::Heard OtherDaemons::heard() const {
  const std::lock_guard lock(mutex_);
  return heard_;
}

}  // namespace lio
