// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/imu_noise_estimator.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lio {
namespace {

using Axes = Eigen::Matrix<double, 6, 1>;  // rate, force

constexpr std::array<double, 7> kFactors{1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0};
constexpr double kSumOfSquares = 924.0;

// Keeps means of so many neighbouring samples each, and the mean square of their sixth differences.
class Differences {
 public:
  explicit Differences(int samples_per_mean) : samples_per_mean_(samples_per_mean) {}

  void Add(const ImuSample& sample) {
    sum_.head<3>() += sample.w_imu_radps;
    sum_.tail<3>() += sample.f_imu_mps2;
    if (++num_in_sum_ < samples_per_mean_) return;
    if (num_means_ == means_.size()) {
      std::rotate(means_.begin(), means_.begin() + 1, means_.end());
      --num_means_;
    }
    means_[num_means_++] = sum_ / num_in_sum_;
    sum_.setZero();
    num_in_sum_ = 0;
    if (num_means_ == means_.size()) AddDifference();
  }

  // The next sample is no neighbour of the last one.
  void Interrupt() {
    num_means_ = 0;
    num_in_sum_ = 0;
    sum_.setZero();
  }

  // Returns the variance of the means' noise; zero where there is no difference.
  [[nodiscard]] Axes Variance() const {
    return num_differences_ == 0 ? Axes(Axes::Zero())
                                 : Axes(squares_ / (kSumOfSquares * num_differences_));
  }

 private:
  void AddDifference() {
    Axes difference = Axes::Zero();
    for (std::size_t i = 0; i < means_.size(); ++i) difference += kFactors[i] * means_[i];
    squares_ += difference.cwiseAbs2();
    ++num_differences_;
  }

  int samples_per_mean_;
  Axes sum_ = Axes::Zero();
  int num_in_sum_ = 0;
  std::array<Axes, kFactors.size()> means_;  // the last ones, oldest first
  std::size_t num_means_ = 0;
  Axes squares_ = Axes::Zero();
  int num_differences_ = 0;
};

}  // namespace

ImuNoise EstimateNoise(std::span<const ImuSample> samples) {
  if (samples.size() < kFactors.size()) return {};
  const double step_s = SecondsBetween(samples.front().stamp, samples.back().stamp) /
                        static_cast<double>(samples.size() - 1);
  if (!(step_s > 0.0)) return {};
  const auto per_mean = std::max(1L, std::lround(1.0 / (kImuNoise.max_rate_hz * step_s)));
  Differences differences(static_cast<int>(per_mean));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double ratio =
        i == 0 ? 1.0 : SecondsBetween(samples[i - 1].stamp, samples[i].stamp) / step_s;
    if (ratio < kImuNoise.min_step_ratio || ratio > kImuNoise.max_step_ratio) {
      differences.Interrupt();
    }
    if (samples[i].is_saturated()) {
      differences.Interrupt();
    } else {
      differences.Add(samples[i]);
    }
  }
  const Axes psd = static_cast<double>(per_mean) * step_s * differences.Variance();
  return {psd.head<3>(), psd.tail<3>()};
}

}  // namespace lio
