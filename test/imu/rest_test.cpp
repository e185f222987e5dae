// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/rest.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

TEST(Rest, StatisticsAreMeanAndSpread) {
  std::vector<ImuSample> samples(2);
  samples[0] = {StampAt(0.0), Vector3(1, 0, 0), Vector3(0, 0, 9)};
  samples[1] = {StampAt(0.5), Vector3(3, 0, 0), Vector3(0, 0, 11)};
  const ImuStatistics statistics = Summarise(samples);
  EXPECT_EQ(statistics.num_samples, 2);
  EXPECT_DOUBLE_EQ(statistics.span_s, 0.5);
  EXPECT_LT((statistics.mean_w_radps - Vector3(2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((statistics.mean_f_mps2 - Vector3(0, 0, 10)).norm(), 1e-12);
  EXPECT_NEAR(statistics.gyro_std_radps, 1.0, 1e-12);
  EXPECT_NEAR(statistics.accel_std_mps2, 1.0, 1e-12);
}

TEST(Rest, StatisticsOfNothingAreZero) {
  EXPECT_EQ(Summarise({}).num_samples, 0);
  EXPECT_EQ(Summarise({}).span_s, 0.0);
}

// The data are 100 steps of 10 ms with noise of 0.01 rad/s and 0.02 m/s^2.
TEST(Rest, CalmIsWhatNoiseAndVibrationExplain) {
  const ImuRig imu;
  ImuStatistics statistics;
  statistics.num_samples = 101;
  statistics.span_s = 1.0;
  statistics.gyro_std_radps = 0.014;
  statistics.accel_std_mps2 = 0.029;
  EXPECT_TRUE(IsCalm(statistics, imu, {}));
  statistics.gyro_std_radps = 0.016;
  EXPECT_FALSE(IsCalm(statistics, imu, {}));
  EXPECT_TRUE(IsCalm(statistics, imu, {0.01, 0.0}));
  statistics.accel_std_mps2 = 0.031;
  EXPECT_FALSE(IsCalm(statistics, imu, {0.01, 0.0}));
  statistics.num_samples = 401;  // each sample has twice the noise
  EXPECT_TRUE(IsCalm(statistics, imu, {}));
}

}  // namespace
}  // namespace lio
