// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/clock_smoother.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>
#include <vector>

#include "lio/filter/clock_offset.hpp"

namespace lio {
namespace {

constexpr double kStep_s = 0.5;
constexpr double kMeasured_std_s = 2e-4;
const ClockBelief kPrior;

Timestamp TimeOf(int scan) {
  return Timestamp{1'700'000'000'000'000'000} + Duration::FromSeconds(kStep_s * scan);
}

// The offset is measured at each scan, as a turn measures it.
ClockEstimate After(ClockEstimate estimate, double measured_s) {
  const double var = estimate.cov(0, 0) + kMeasured_std_s * kMeasured_std_s;
  const Eigen::Vector2d gain = estimate.cov.col(0) / var;
  estimate.mean += gain * (measured_s - estimate.mean[0]);
  estimate.cov -= gain * estimate.cov.row(0).eval();
  return estimate;
}

std::vector<ClockEstimate> Filtered(const std::vector<double>& measured_s) {
  std::vector<ClockEstimate> estimates = {
      After({kPrior.mean, kPrior.cov, TimeOf(0)}, measured_s[0])};
  for (std::size_t i = 1; i < measured_s.size(); ++i) {
    const ClockEstimate before = Predicted(estimates.back(), TimeOf(static_cast<int>(i)));
    estimates.push_back(After(before, measured_s[i]));
  }
  return estimates;
}

std::vector<double> DriftingOffsets(int num, double rate) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, kMeasured_std_s);
  std::vector<double> measured_s;
  for (int i = 0; i < num; ++i) {
    measured_s.push_back(0.003 + rate * kStep_s * i + noise(random));
  }
  return measured_s;
}

// The same model, solved for all scans at once: unknowns are the rate, then the offsets.
Eigen::VectorXd LeastSquares(const std::vector<double>& measured_s) {
  const auto num = static_cast<Eigen::Index>(measured_s.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(num + 1, num + 1);
  Eigen::VectorXd score = Eigen::VectorXd::Zero(num + 1);
  information(0, 0) += 1.0 / kPrior.cov(1, 1);
  information(1, 1) += 1.0 / kPrior.cov(0, 0);
  const double walk_std_s = kFilterParameters.clock_offset.walk_s_per_sqrt_s;
  for (Eigen::Index i = 0; i < num; ++i) {
    const double weight = 1.0 / (kMeasured_std_s * kMeasured_std_s);
    information(i + 1, i + 1) += weight;
    score[i + 1] += weight * measured_s[static_cast<std::size_t>(i)];
    if (i == 0) continue;
    Eigen::VectorXd step = Eigen::VectorXd::Zero(num + 1);
    step[0] = -kStep_s;
    step[i] = -1.0;
    step[i + 1] = 1.0;
    information += step * step.transpose() / (walk_std_s * walk_std_s * kStep_s);
  }
  return information.ldlt().solve(score);
}

TEST(ClockSmootherTest, IsTheLeastSquaresSolutionOverAllScans) {
  const std::vector<double> measured_s = DriftingOffsets(60, 4e-5);
  const std::vector<ClockEstimate> estimates = Filtered(measured_s);
  const Eigen::VectorXd expected = LeastSquares(measured_s);
  ClockSmoother smoother;
  for (int i = 59; i >= 0; --i) {
    const auto offset_s = smoother.Back(TimeOf(i), estimates[static_cast<std::size_t>(i)]);
    ASSERT_TRUE(offset_s);
    EXPECT_NEAR(*offset_s, expected[i + 1], 1e-9) << i;
  }
}

TEST(ClockSmootherTest, WhatIsFoundLaterGoesBackAtItsRate) {
  const ClockEstimate found{{0.004, 2e-5}, kPrior.cov, TimeOf(20)};
  ClockSmoother smoother;
  EXPECT_FALSE(smoother.Back(TimeOf(22), std::nullopt));
  EXPECT_DOUBLE_EQ(*smoother.Back(TimeOf(20), found), 0.004);
  EXPECT_NEAR(*smoother.Back(TimeOf(0), std::nullopt), 0.004 - 2e-5 * 20 * kStep_s, 1e-12);
}

// Degenerate scans tell nothing: the estimate of before goes on at its rate.
TEST(ClockSmootherTest, ScansThatTellNothingHaveTheOffsetOfTheirTime) {
  const std::vector<double> measured_s = DriftingOffsets(20, 4e-5);
  const std::vector<ClockEstimate> estimates = Filtered(measured_s);
  ClockSmoother smoother;
  const double last_s = *smoother.Back(TimeOf(25), estimates.back());
  const double at_19_s = *smoother.Back(TimeOf(19), estimates.back());
  EXPECT_NEAR(at_19_s, estimates.back().mean[0], 1e-12);
  EXPECT_NEAR(last_s, at_19_s + estimates.back().mean[1] * 6 * kStep_s, 1e-12);
}

TEST(ClockSmootherTest, AnotherClockTellsNothingOfTheOneBefore) {
  const ClockEstimate before = Filtered(DriftingOffsets(20, 0.0)).back();
  const ClockEstimate other{{-0.02, 0.0}, kPrior.cov, TimeOf(21)};
  ClockSmoother smoother;
  EXPECT_DOUBLE_EQ(*smoother.Back(TimeOf(21), other), -0.02);
  EXPECT_DOUBLE_EQ(*smoother.Back(TimeOf(19), before), before.mean[0]);
}

}  // namespace
}  // namespace lio
