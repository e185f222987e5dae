// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/sender_watch.hpp"

#include <utility>

namespace lio {

// A sample goes on with the kept sender's sequence if its number and its stamp advance by the same
// count of steps. A repeated sample advances by none in both.
bool SenderWatch::GoesOn(const Newest& sample) {
  // The difference is modulo 2^32, as numbers wrap.
  const std::int64_t apart = static_cast<std::int32_t>(sample.seq - kept_->seq);
  const Duration passed = sample.stamp - kept_->stamp;
  if (step_ == Duration{}) {
    if (apart != 1 || passed <= Duration{}) return false;
    step_ = passed;
  }
  if (apart == 0) return passed == Duration{};
  if (apart > kSenderWatch.max_apart || -apart > kSenderWatch.max_apart) return false;
  const Duration off{passed.ns - apart * step_.ns};
  if (2 * Abs(off).ns > step_.ns) return false;
  constexpr std::int64_t kMean = kSenderWatch.mean_of_steps;
  if (apart == 1) step_ = {((kMean - 1) * step_.ns + passed.ns) / kMean};
  return true;
}

void SenderWatch::TakeOther(const Newest& sample) {
  const bool is_next = other_ && sample.seq == other_->seq + 1;
  if (!is_next) {
    evidence_ = evidence_ >= kSenderWatch.min_evidence ? evidence_ : 0;
  } else if (has_kept_gone_on_) {
    ++evidence_;
  }
  ++num_others_in_a_row_;
  has_kept_gone_on_ = false;
  other_ = sample;
}

bool SenderWatch::IsForeign(std::int32_t seq, Timestamp stamp) {
  const Newest sample{static_cast<std::uint32_t>(seq), stamp};
  if (!kept_) {
    kept_ = sample;
    return false;
  }
  if (GoesOn(sample)) {
    if (stamp > kept_->stamp) kept_ = sample;
    has_kept_gone_on_ = true;
    num_others_in_a_row_ = 0;
    return false;
  }
  TakeOther(sample);
  const bool is_proven = evidence_ >= kSenderWatch.min_evidence;
  const bool is_gone = num_others_in_a_row_ >= kSenderWatch.gone_after &&
                       (!is_proven || Abs(stamp - kept_->stamp) > kSenderWatch.gone_for);
  if (!is_gone) return is_proven;
  *this = {};
  kept_ = sample;
  return false;
}

}  // namespace lio
