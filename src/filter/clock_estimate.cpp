// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/clock_estimate.hpp"

#include "lio/filter/filter_parameters.hpp"

namespace lio {

double PassedTime_s(Timestamp before, Timestamp now) {
  const double span_s = SecondsBetween(before, now);
  return span_s > 0.0 && span_s <= kFilterParameters.clock_offset.max_span_s ? span_s : 0.0;
}

Eigen::Matrix2d ClockTransition(double span_s) {
  Eigen::Matrix2d transition = Eigen::Matrix2d::Identity();
  transition(0, 1) = span_s;
  return transition;
}

ClockEstimate Predicted(const ClockEstimate& estimate, Timestamp now) {
  const double span_s = PassedTime_s(estimate.as_of, now);
  const Eigen::Matrix2d transition = ClockTransition(span_s);
  ClockEstimate later{transition * estimate.mean,
                      transition * estimate.cov * transition.transpose(), now};
  constexpr double kWalk = kFilterParameters.clock_offset.walk_s_per_sqrt_s;
  later.cov(0, 0) += kWalk * kWalk * span_s;
  return later;
}

}  // namespace lio
