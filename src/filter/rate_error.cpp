// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/rate_error.hpp"

#include <algorithm>
#include <cmath>

namespace lio {
namespace {

constexpr RateErrorParameters kRateError;
constexpr double kPriorTurnSq = kRateError.prior_turn_rad * kRateError.prior_turn_rad;
constexpr double kMaxVar = kRateError.max_std_ratio * kRateError.max_std_ratio;
constexpr double kPriorVar = kRateError.prior_std_ratio * kRateError.prior_std_ratio;
constexpr double kPriorWeight = kPriorTurnSq * kPriorTurnSq;
constexpr double kMatchVar = kRateError.match_std_rad * kRateError.match_std_rad;

}  // namespace

double RateError::std_ratio() const {
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
  if (!(turn_sq > 0.0)) return;
  const double without = cov.trace() / 3.0 - variance_rad2_;
  const double error_sq = std::min(residual_rad.squaredNorm() / 3.0 - without, kMaxVar * turn_sq);
  usual_var_rad2_ =
      std::max(kMatchVar, std::min(without, kRateError.usual_growth * usual_var_rad2_));
  const double times_usual = std::max(1.0, without / usual_var_rad2_);
  const double weight = std::min(turn_sq * turn_sq, kRateError.max_turns_a_pose * kPriorWeight) /
                        (times_usual * times_usual);
  weight_sum_ += weight;
  product_sum_ += weight * error_sq / turn_sq;
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
