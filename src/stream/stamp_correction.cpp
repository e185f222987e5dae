// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/stamp_correction.hpp"

#include <algorithm>

namespace lio {

void StampCorrection::Learn(std::size_t num_unmatched) {
  // The match after which an initialization matches earlier sweeps once more is not counted before
  // they are done: what they show comes after it.
  const std::size_t num_matched = num_sweeps_ - std::min(num_sweeps_, num_unmatched);
  const std::size_t known_after = std::max(num_matched, num_matched_ + 1);
  num_matched_ = std::max(num_matched, num_matched_);
  if (newest_ != known_.back().correction) known_.push_back({known_after, newest_});
  while (known_.size() > 1 && known_[1].num_matched + lag_ <= num_sweeps_ + 1) known_.pop_front();
}

}  // namespace lio
