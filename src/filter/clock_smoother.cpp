// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/clock_smoother.hpp"

namespace lio {

// An estimate that is less sure than time alone makes it was begun anew in between: the clock is
// another one, or was set, and tells nothing of the time before.
void ClockSmoother::GoBackTo(const ClockEstimate& before) {
  const ClockEstimate predicted = Predicted(before, filtered_->as_of);
  constexpr double kRounding = 1e-9;
  const bool is_same_clock = filtered_->cov(0, 0) <= (1.0 + kRounding) * predicted.cov(0, 0);
  const Eigen::Vector2d ahead = smoothed_ - predicted.mean;
  smoothed_ = before.mean;
  if (!is_same_clock) return;
  const Eigen::Matrix2d transition = ClockTransition(PassedTime_s(before.as_of, predicted.as_of));
  const Eigen::Matrix2d gain = before.cov * transition.transpose() * predicted.cov.inverse();
  smoothed_ += gain * ahead;
}

std::optional<double> ClockSmoother::Back(Timestamp stamp,
                                          const std::optional<ClockEstimate>& estimate) {
  if (estimate && filtered_) {
    GoBackTo(*estimate);
  } else if (estimate) {
    smoothed_ = estimate->mean;
  }
  if (estimate) filtered_ = estimate;
  if (!filtered_) return std::nullopt;
  return (ClockTransition(SecondsBetween(filtered_->as_of, stamp)) * smoothed_)[0];
}

}  // namespace lio
