// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/rate_error.hpp"

#include <algorithm>
#include <cmath>

namespace lio {
namespace {

constexpr RateErrorParameters kRateError;
constexpr double kPriorTurnSq = kRateError.prior_turn_rad * kRateError.prior_turn_rad;
constexpr double kPriorWeight = kPriorTurnSq * kPriorTurnSq;
constexpr double kMaxVar = kRateError.max_std_ratio * kRateError.max_std_ratio;

}  // namespace

double RateError::std_ratio() const {
  constexpr double kPriorVar = kRateError.prior_std_ratio * kRateError.prior_std_ratio;
  const double var = (kPriorWeight * kPriorVar + product_sum_) / (kPriorWeight + weight_sum_);
  return std::sqrt(std::clamp(var, 0.0, kMaxVar));
}

double RateError::Psd(double rate_radps) const {
  const double error_radps = std_ratio() * rate_radps;
  return error_radps * error_radps * interval_s_;
}

void RateError::Turn(double rate_radps, double dt_s) {
  turn_rad_ += rate_radps * dt_s;
  turn_time_s_ += dt_s;
  variance_rad2_ += Psd(rate_radps) * dt_s;
}

void RateError::AddPose(const Vector3& residual_rad, const Matrix3& cov) {
  const double turn_sq = turn_rad_ * turn_rad_;
  const double without = cov.trace() / 3.0 - variance_rad2_;
  const double error_sq = std::min(residual_rad.squaredNorm() / 3.0 - without, kMaxVar * turn_sq);
  weight_sum_ += turn_sq * turn_sq;
  product_sum_ += turn_sq * error_sq;
  const double excess = weight_sum_ / (kRateError.num_turns_remembered * kPriorWeight);
  if (excess > 1.0) {
    weight_sum_ /= excess;
    product_sum_ /= excess;
  }
}

void RateError::BeginTurn() {
  if (turn_time_s_ > 0.0) interval_s_ = turn_time_s_;
  turn_rad_ = 0.0;
  turn_time_s_ = 0.0;
  variance_rad2_ = 0.0;
}

}  // namespace lio
