// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Corrects a sweep's stamps by the clock offset that matched sweeps have shown
// (pipeline/clock_offset_follower.hpp). A sweep gets the correction that was known when it was
// `lag` sweeps away from being matched, so its stamps do not depend on how fast sweeps are matched.
#pragma once

#include <cstddef>
#include <deque>

#include "lio/base/time.hpp"

namespace lio {

class StampCorrection {
 public:
  // `lag` counts sweeps and is at least 1.
  explicit StampCorrection(std::size_t lag) : lag_(lag) {}

  // Does the next sweep's correction depend on a sweep that is not matched yet, when so many are
  // not?
  [[nodiscard]] bool IsUnknown(std::size_t num_unmatched) const { return num_unmatched >= lag_; }
  // Matched sweeps show this now.
  void SetNewest(Duration correction) { newest_ = correction; }
  // The newest correction is known while so many sweeps are given out and not yet matched. To be
  // called after each match, before the next sweeps are given out.
  void Learn(std::size_t num_unmatched);
  // For the sweeps that are given out until the next call of Learn(), however many: those that one
  // message sets free have one correction.
  [[nodiscard]] Duration ForNextSweeps() const { return known_.front().correction; }
  // A sweep is given out.
  void CountSweep() { ++num_sweeps_; }

 private:
  struct Known {
    std::size_t num_matched = 0;  // sweeps that had been matched before it was known
    Duration correction;
  };

  std::size_t lag_;
  std::size_t num_sweeps_ = 0;   // given out
  std::size_t num_matched_ = 0;  // given out, and matched at least once
  Duration newest_;
  std::deque<Known> known_{Known{}};  // ascending; the first one holds for the next sweeps
};

}  // namespace lio
