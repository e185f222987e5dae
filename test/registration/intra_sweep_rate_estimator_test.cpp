// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/intra_sweep_rate_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lio/registration/match_summary.hpp"

namespace lio {
namespace {

constexpr int kNumPoints = 3000;
constexpr int kNumParts = 300;
constexpr float kWeight = 1.f / (0.02f * 0.02f);

// Returns a sweep of a round room, seen from its middle, deskewed with a turn rate that is off by
// -`error`.
IntraSweepRateEstimator SumsOfRoom(const Vector3& error_radps, double noise_m, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> height(-3.f, 3.f);
  std::normal_distribution<float> noise(0.f, 1.f);
  IntraSweepRateEstimator sums;
  sums.Reset(kNumParts);
  for (int i = 0; i < kNumPoints; ++i) {
    const float t = 0.1f * (static_cast<float>(i) / kNumPoints - 0.5f);
    const float azimuth = 62.8f * t;
    const Eigen::Vector3f point(8.f * std::cos(azimuth), 8.f * std::sin(azimuth), height(random));
    const Eigen::Vector3f normal(std::cos(2.f * azimuth), std::sin(2.f * azimuth), 0.3f);
    const Vector6f row = JacobianRow(point, normal.normalized());
    const float off = -t * row.tail<3>().dot(error_radps.cast<float>());
    const float residual = off + static_cast<float>(noise_m) * noise(random);
    sums.Add(i * kNumParts / kNumPoints, row, residual, kWeight, t);
  }
  return sums;
}

TEST(IntraSweepRateEstimator, FindWhatTheTurnRateIsOffBy) {
  const Vector3 error(0.03, -0.05, 0.04);
  const TurnRate found = SumsOfRoom(error, 0.0, 1).Solve(1.0);
  EXPECT_LT((found.w_imu_radps - error).norm(), 1e-4);
}

TEST(IntraSweepRateEstimator, CovarianceIsThatOfTheErrors) {
  constexpr int kNumRuns = 200;
  double nees = 0.0;
  for (unsigned seed = 1; seed <= kNumRuns; ++seed) {
    const TurnRate found = SumsOfRoom(Vector3::Zero(), 0.02, seed).Solve(1.0);
    nees += found.w_imu_radps.dot(found.cov.ldlt().solve(found.w_imu_radps)) / 3.0;
  }
  EXPECT_NEAR(nees / kNumRuns, 1.0, 0.25);
}

TEST(IntraSweepRateEstimator, WithoutTermsNothingIsClaimed) {
  IntraSweepRateEstimator sums;
  sums.Reset(1);
  const TurnRate found = sums.Solve(1.0);
  EXPECT_EQ(found.w_imu_radps, Vector3(Vector3::Zero()));
  EXPECT_GT(found.cov(0, 0), 0.2);
}

TEST(IntraSweepRateEstimator, ResetForgets) {
  IntraSweepRateEstimator sums = SumsOfRoom(Vector3(0.1, 0, 0), 0.0, 1);
  sums.Reset(kNumParts);
  EXPECT_EQ(sums.Solve(1.0).w_imu_radps, Vector3(Vector3::Zero()));
}

}  // namespace
}  // namespace lio
