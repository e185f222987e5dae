// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/sequence_holes.hpp"

namespace lio {

void SequenceHoles::Advance(std::int32_t step) {
  came_ = came_ << step | 1;
  newest_ += static_cast<std::uint32_t>(step);
  num_missing_ += step - 1;
  far_.reset();
}

void SequenceHoles::Add(std::int32_t number) {
  const auto seen = static_cast<std::uint32_t>(number);
  const auto step_from = [&](std::uint32_t from) { return static_cast<std::int32_t>(seen - from); };
  const std::int32_t step = step_from(newest_);
  if (has_begun_ && step > 0 && step <= kReach) return Advance(step);
  if (has_begun_ && step <= 0 && step >= -kReach) {
    const std::uint64_t bit = std::uint64_t{1} << -step;
    if ((came_ & bit) == 0) --num_missing_;
    came_ |= bit;
    far_.reset();
    return;
  }
  // A jump is believed once the next number bears it out.
  const bool goes_on = far_ && step_from(*far_) > 0 && step_from(*far_) <= kReach;
  if (has_begun_ && !goes_on) {
    far_ = seen;
    return;
  }
  const std::uint32_t begin = has_begun_ ? *far_ : seen;
  const auto hole = static_cast<std::int32_t>(begin - newest_);
  if (has_begun_ && hole > 0 && hole <= kMaxHole) num_missing_ += hole - 1;
  has_begun_ = true;
  newest_ = begin;
  came_ = ~std::uint64_t{0};
  if (begin != seen) Advance(step_from(begin));
}

}  // namespace lio
