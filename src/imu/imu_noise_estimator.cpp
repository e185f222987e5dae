// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/imu_noise_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace lio {
namespace {

constexpr std::array<double, 7> kFactors{1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0};
constexpr double kSumOfSquares = 924.0;
constexpr double kStepKeep = 0.98;  // of the mean step, from sample to sample

}  // namespace

void ImuNoiseEstimator::Interrupt() {
  has_last_ = false;
  ForgetNeighbours();
}

void ImuNoiseEstimator::ForgetNeighbours() {
  num_blocks_ = 0;
  num_in_block_ = 0;
  block_sum_.setZero();
}

void ImuNoiseEstimator::Add(ImuSample& sample) {
  const double step_s = has_last_ ? SecondsBetween(last_, sample.stamp) : 0.0;
  if (!has_last_ || step_s > 0.0) {
    if (mean_step_s_ > 0.0 && step_s > kImuNoise.max_step_ratio * mean_step_s_) {
      ForgetNeighbours();
    } else if (step_s > 0.0) {
      mean_step_s_ =
          mean_step_s_ > 0.0 ? kStepKeep * mean_step_s_ + (1.0 - kStepKeep) * step_s : step_s;
    }
    last_ = sample.stamp;
    has_last_ = true;
    if (sample.is_rate_saturated || sample.is_force_saturated) {
      ForgetNeighbours();
    } else {
      AddToBlock(sample);
    }
  }
  sample.gyro_noise_psd = psd_.head<3>();
  sample.accel_noise_psd = psd_.tail<3>();
}

void ImuNoiseEstimator::AddToBlock(const ImuSample& sample) {
  block_sum_.head<3>() += sample.w_imu_radps;
  block_sum_.tail<3>() += sample.f_imu_mps2;
  ++num_in_block_;
  const double wanted = mean_step_s_ > 0.0 ? 1.0 / (kImuNoise.max_rate_hz * mean_step_s_) : 1.0;
  if (num_in_block_ < std::lround(wanted)) return;
  if (num_blocks_ == blocks_.size()) {
    std::rotate(blocks_.begin(), blocks_.begin() + 1, blocks_.end());
    --num_blocks_;
  }
  blocks_[num_blocks_++] = block_sum_ / num_in_block_;
  if (num_blocks_ == blocks_.size()) AddBlock();
  block_sum_.setZero();
  num_in_block_ = 0;
}

void ImuNoiseEstimator::AddBlock() {
  Vector6 difference = Vector6::Zero();
  for (std::size_t i = 0; i < blocks_.size(); ++i) difference += kFactors[i] * blocks_[i];
  const double block_s = num_in_block_ * mean_step_s_;
  const double share = std::min(1.0, block_s / kImuNoise.window_s);
  weight_ += share * (1.0 - weight_);
  psd_ += share / weight_ * (block_s / kSumOfSquares * difference.cwiseAbs2() - psd_);
}

}  // namespace lio
