// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/run_tally.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "lio/base/angle.hpp"

namespace lio {
namespace {

std::size_t BinOf(double ratio) {
  const double bin = std::floor(std::log2(std::max(ratio, 1.0)));
  return std::min(static_cast<std::size_t>(bin), RunTallyParameters::kNumNoiseBins - 1);
}

double MedianOf(std::span<const std::int64_t> bins) {
  std::int64_t total = 0;
  for (const std::int64_t num : bins) total += num;
  std::int64_t below = 0;
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    below += bins[bin];
    if (total > 0 && 2 * below >= total) return std::exp2(static_cast<double>(bin));
  }
  return 0.0;
}

}  // namespace

void RunTally::Include(Timestamp stamp) {
  if (!first_) first_ = stamp;
  const double step_s = newest_ ? SecondsBetween(*newest_, stamp) : 0.0;
  if (step_s < 0.0 && step_s > -kRunTally.max_input_step_s) return;
  if (step_s > 0.0 && step_s < kRunTally.max_input_step_s) total_s_ += step_s;
  newest_ = stamp;
}

void RunTally::AddImu(Timestamp stamp) {
  const bool is_slow = last_imu_ && SecondsBetween(*last_imu_, stamp) > kRunTally.slow_imu_s;
  num_slow_imu_ += is_slow ? 1 : 0;
  ++num_imu_;
  last_imu_ = stamp;
  Include(stamp);
}

void RunTally::AddSweep(Timestamp end) {
  last_sweep_ = end;
  Include(end);
}

void RunTally::AddRow(const PoseRow& row) {
  ++num_rows_;
  if (row.imu_noise.gyro > 0.0) ++gyro_noise_[BinOf(row.imu_noise.gyro)];
  if (row.imu_noise.accel > 0.0) ++accel_noise_[BinOf(row.imu_noise.accel)];
  if (!first_pose_) first_pose_ = row.T_map_imu;
  turned_rad_ = std::max(turned_rad_,
                         LogSo3(first_pose_->rotation.conjugate() * row.T_map_imu.rotation).norm());
  if (last_row_) {
    const double step_s = SecondsBetween(last_row_->stamp, row.stamp);
    if (row.is_located && step_s > 0.0) covered_s_ += std::min(step_s, kRunTally.max_step_s);
    guess_s_ = row.is_guessed ? guess_s_ + std::clamp(step_s, 0.0, kRunTally.max_step_s) : 0.0;
    longest_guess_s_ = std::max(longest_guess_s_, guess_s_);
    path_m_ += (row.T_map_imu.translation - last_row_->T_map_imu.translation).norm();
  }
  last_row_ = row;
}

double RunTally::Coverage() const {
  if (num_rows_ == 0) return 0.0;
  return std::min(1.0, covered_s_ / std::max(total_s_ - kRunTally.start_s, 1e-3));
}

ClaimedAccuracy RunTally::Claimed() const {
  ClaimedAccuracy claimed;
  if (!last_row_) return claimed;
  const Matrix3 R = last_row_->R_world_imu.toRotationMatrix();
  const Matrix3 tilt_cov = R * last_row_->rotation_cov * R.transpose();
  claimed.tilt_std_deg = kDegPerRad * std::sqrt(tilt_cov.topLeftCorner<2, 2>().trace());
  if (path_m_ >= kRunTally.min_path_m) {
    claimed.position_std_m_per_100m = std::sqrt(last_row_->position_cov.trace()) * 100.0 / path_m_;
  }
  return claimed;
}

double RunTally::WithoutSweeps_s() const {
  if (!last_imu_) return 0.0;
  if (!last_sweep_) return total_s_;
  return std::max(0.0, SecondsBetween(*last_sweep_, *last_imu_));
}

double RunTally::WithoutImu_s() const {
  if (!last_sweep_) return 0.0;
  if (!last_imu_) return total_s_;
  return std::max(0.0, SecondsBetween(*last_imu_, *last_sweep_));
}

ImuNoiseRatios RunTally::MedianNoise() const {
  return {MedianOf(gyro_noise_), MedianOf(accel_noise_)};
}

}  // namespace lio
