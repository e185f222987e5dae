// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/stamp_correction.hpp"

#include <algorithm>

namespace lio {

void StampCorrection::Learn(std::size_t num_unmatched, Duration correction) {
  if (correction == known_.back().correction) return;
  // Sweeps that an initialization matches once more do not take back what was matched.
  const std::size_t num_matched = num_sweeps_ - std::min(num_sweeps_, num_unmatched);
  known_.push_back({std::max(num_matched, known_.back().num_matched), correction});
}

Duration StampCorrection::ForNextSweep() {
  while (known_.size() > 1 && known_[1].num_matched + lag_ <= num_sweeps_ + 1) known_.pop_front();
  return known_.front().correction;
}

}  // namespace lio
