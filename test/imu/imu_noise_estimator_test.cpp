// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/imu_noise_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace lio {
namespace {

// Holds standard deviations of the white noise from sample to sample.
struct Noise {
  Vector3 gyro_std_radps = Vector3::Constant(1e-3);
  Vector3 accel_std_mps2 = Vector3::Constant(0.02);
};

// Makes samples of white noise on top of a body's own force, and estimates from the last second.
class NoisyImu {
 public:
  explicit NoisyImu(double rate_hz) : step_ns_(std::llround(1e9 / rate_hz)) {}

  ImuNoise Run(
      double seconds, const Noise& noise,
      const std::function<double(double)>& own_force_mps2 = [](double) { return 0.0; }) {
    const auto num = std::llround(seconds * 1e9 / static_cast<double>(step_ns_));
    for (std::int64_t i = 0; i < num; ++i) {
      now_ns_ += step_ns_;
      ImuSample sample;
      sample.stamp = {now_ns_};
      const double own = own_force_mps2(static_cast<double>(now_ns_) * 1e-9);
      sample.w_imu_radps = noise.gyro_std_radps.cwiseProduct(Draw());
      sample.f_imu_mps2 = noise.accel_std_mps2.cwiseProduct(Draw()) + Vector3(own, own, 9.8 + own);
      samples_.push_back(sample);
    }
    return EstimateLast();
  }
  void Pause(double seconds) { now_ns_ += std::llround(seconds * 1e9); }
  ImuNoise EstimateLast() const {
    const Timestamp from = samples_.back().stamp - Duration::FromSeconds(kImuNoise.window_s);
    std::size_t first = samples_.size();
    while (first > 0 && samples_[first - 1].stamp >= from) --first;
    return EstimateNoise(std::span(samples_).subspan(first));
  }
  double step_s() const { return static_cast<double>(step_ns_) * 1e-9; }
  std::vector<ImuSample>& samples() { return samples_; }

 private:
  Vector3 Draw() {
    std::normal_distribution<double> normal;
    const double x = normal(random_);
    const double y = normal(random_);
    return {x, y, normal(random_)};
  }

  std::int64_t step_ns_;
  std::int64_t now_ns_ = 0;
  std::mt19937_64 random_{7};
  std::vector<ImuSample> samples_;
};

// The largest and the smallest of a few estimates lie within this of the truth: each has some 30
// degrees of freedom, so 26 % of spread, one sigma.
constexpr double kSpread = 0.8;

void ExpectNear(const Vector3& psd, const Vector3& std, double step_s) {
  for (int i = 0; i < 3; ++i) {
    const double truth = std[i] * std[i] * step_s;
    EXPECT_GT(psd[i], (1.0 - kSpread) * truth) << i;
    EXPECT_LT(psd[i], (1.0 + kSpread) * truth) << i;
  }
}

TEST(ImuNoiseEstimator, LearnsWhiteNoiseOfEachAxisAtAnyRate) {
  const Noise noise{{1e-3, 4e-3, 16e-3}, {0.02, 0.1, 0.5}};
  for (const double rate_hz : {50.0, 100.0, 200.0, 400.0, 1000.0}) {
    NoisyImu imu(rate_hz);
    const ImuNoise last = imu.Run(2.0, noise);
    ExpectNear(last.gyro_psd, noise.gyro_std_radps, imu.step_s());
    ExpectNear(last.accel_psd, noise.accel_std_mps2, imu.step_s());
  }
}

TEST(ImuNoiseEstimator, IsRightOnTheMean) {
  NoisyImu imu(100.0);
  const Noise noise;
  double sum = 0.0;
  imu.Run(5.0, noise);
  for (int i = 0; i < 200; ++i) sum += imu.Run(1.0, noise).accel_psd.mean();
  EXPECT_NEAR(sum / 200.0, 0.02 * 0.02 * 0.01, 0.05 * 0.02 * 0.02 * 0.01);
}

TEST(ImuNoiseEstimator, DoesNotTakeTheBodysOwnMotionForNoise) {
  const auto swing = [](double hz) {
    return [hz](double t_s) { return std::sin(2.0 * std::numbers::pi * hz * t_s); };
  };
  const Noise noise;
  // The body's springs swing at 1.5 Hz and a wheel hops at 10 Hz, 1 m/s^2 each.
  for (const double hz : {1.5, 10.0}) {
    NoisyImu imu(100.0);
    const ImuNoise last = imu.Run(2.0, noise, swing(hz));
    ExpectNear(last.accel_psd, noise.accel_std_mps2, imu.step_s());
  }
}

TEST(ImuNoiseEstimator, FollowsVibrationWithinASecond) {
  NoisyImu imu(100.0);
  const Noise calm;
  const Noise shaken{Vector3::Constant(0.015), Vector3::Constant(0.8)};
  imu.Run(2.0, calm);
  ExpectNear(imu.Run(1.1, shaken).accel_psd, shaken.accel_std_mps2, imu.step_s());
  ExpectNear(imu.Run(1.1, calm).accel_psd, calm.accel_std_mps2, imu.step_s());
}

TEST(ImuNoiseEstimator, KnowsNothingBeforeSevenSamples) {
  EXPECT_TRUE(NoisyImu(100.0).Run(0.06, {}).accel_psd.isZero());
  EXPECT_GT(NoisyImu(100.0).Run(0.07, {}).accel_psd.minCoeff(), 0.0);
  EXPECT_TRUE(EstimateNoise({}).gyro_psd.isZero());
  const std::vector<ImuSample> at_one_instant(20);
  EXPECT_TRUE(EstimateNoise(at_one_instant).gyro_psd.isZero());
}

TEST(ImuNoiseEstimator, AGapIsNoNoise) {
  NoisyImu imu(100.0);
  const Noise noise;
  const auto ramp = [](double t_s) { return 3.0 * t_s; };  // a gap of 0.3 s is a step of 0.9 m/s^2
  Vector3 mean = Vector3::Zero();
  for (int i = 0; i < 20; ++i) {
    imu.Run(0.4, noise, ramp);
    imu.Pause(0.3);
    mean += imu.Run(0.3, noise, ramp).accel_psd / 20.0;
  }
  ExpectNear(mean, noise.accel_std_mps2, imu.step_s());
}

TEST(ImuNoiseEstimator, SaturatedSamplesTellNothing) {
  NoisyImu imu(100.0);
  const Noise noise;
  imu.Run(1.0, noise);
  for (std::size_t i = 40; i < 45; ++i) {
    imu.samples()[i].f_imu_mps2 = Vector3::Constant(80.0);
    imu.samples()[i].is_force_saturated = true;
  }
  ExpectNear(imu.EstimateLast().accel_psd, noise.accel_std_mps2, imu.step_s());
}

}  // namespace
}  // namespace lio
