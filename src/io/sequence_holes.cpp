// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/sequence_holes.hpp"

namespace lio {

void SequenceHoles::BeginAt(std::uint32_t number) {
  has_begun_ = true;
  newest_ = number;
  came_ = ~std::uint64_t{0};
  far_.reset();
}

void SequenceHoles::Advance(std::int32_t step) {
  came_ = came_ << step | 1;
  newest_ += static_cast<std::uint32_t>(step);
  num_missing_ += step - 1;
  far_.reset();
}

void SequenceHoles::FillIn(std::int32_t steps_back) {
  const std::uint64_t bit = std::uint64_t{1} << steps_back;
  if ((came_ & bit) == 0) --num_missing_;
  came_ |= bit;
  far_.reset();
}

void SequenceHoles::Add(std::int32_t number) {
  const auto seen = static_cast<std::uint32_t>(number);
  if (!has_begun_) return BeginAt(seen);
  const auto step_from = [&](std::uint32_t from) { return static_cast<std::int32_t>(seen - from); };
  const auto is_next = [](std::int32_t step) { return step > 0 && step <= kReach; };
  const std::int32_t step = step_from(newest_);
  if (is_next(step)) return Advance(step);
  if (step <= 0 && step >= -kReach) return FillIn(-step);
  // A jump is believed once the next number bears it out.
  if (!far_ || !is_next(step_from(*far_))) {
    far_ = seen;
    return;
  }
  const std::uint32_t begin = *far_;
  const auto hole = static_cast<std::int32_t>(begin - newest_);
  if (hole > 0 && hole <= kMaxHole) num_missing_ += hole - 1;
  BeginAt(begin);
  Advance(step_from(begin));
}

}  // namespace lio
