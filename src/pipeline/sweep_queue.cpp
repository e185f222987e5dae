// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/sweep_queue.hpp"

#include <algorithm>
#include <utility>

namespace lio {

SweepPtr SweepQueue::StartNext(std::size_t next) {
  if (in_flight_ || next >= sweeps_.size()) return nullptr;
  in_flight_ = sweeps_[next];
  return in_flight_;
}

bool SweepQueue::Finish(const SweepPtr& sweep, std::size_t next) {
  const SweepPtr in_flight = std::exchange(in_flight_, nullptr);
  return in_flight && sweep == in_flight && next < sweeps_.size() && sweeps_[next] == in_flight;
}

std::size_t SweepQueue::NumUnmatched(std::size_t next) const {
  const std::size_t num_matched = std::min(next, sweeps_.size());
  return std::max<std::size_t>(sweeps_.size() - num_matched, in_flight_ ? 1 : 0);
}

void SweepQueue::AddSetFree(std::size_t num_sweeps) {
  if (num_sweeps > 1) num_freed_at_once_ += num_sweeps;
}

std::size_t SweepQueue::Shed(std::size_t next, bool looks_back) {
  const std::size_t first = next + (in_flight_ ? 1 : 0);
  num_freed_at_once_ = std::min(num_freed_at_once_, sweeps_.size());
  const std::size_t limit =
      max_waiting_ + num_freed_at_once_ + (looks_back ? kSweepQueue.max_looked_back_on : 0) + first;
  if (sweeps_.size() <= limit) return 0;
  const std::size_t num_shed = sweeps_.size() - limit;
  const auto oldest = sweeps_.begin() + static_cast<std::ptrdiff_t>(first);
  sweeps_.erase(oldest, oldest + static_cast<std::ptrdiff_t>(num_shed));
  return num_shed;
}

}  // namespace lio
