// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/rate_meter.hpp"

#include <algorithm>

namespace lio {

void RateMeter::Add(std::int64_t utime) {
  if (!utimes_.empty() && utime < utimes_.back()) utimes_.clear();  // the clock was set back
  utimes_.push_back(utime);
  while (utimes_.size() > kMaxMessages || utime - utimes_.front() > kWindow_us) {
    utimes_.pop_front();
  }
}

double RateMeter::RateHz(std::int64_t now_utime) const {
  const std::int64_t begin = now_utime - kWindow_us;
  const auto first = std::lower_bound(utimes_.begin(), utimes_.end(), begin);
  const auto num = utimes_.end() - first;
  if (num < 2) return 0.0;
  // A stream that goes on is counted by its intervals; where it has stopped the silence counts,
  // too.
  const double intervals = static_cast<double>(num - 1);
  const double streamed_s = 1e-6 * static_cast<double>(utimes_.back() - *first);
  const double silent_s = 1e-6 * static_cast<double>(now_utime - utimes_.back());
  const double usual_s = streamed_s / intervals;
  const double span_s = streamed_s + std::max(0.0, silent_s - usual_s);
  return span_s > 0.0 ? intervals / span_s : 0.0;
}

}  // namespace lio
