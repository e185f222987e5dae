// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/consistency.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

namespace lio {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

// Returns a covariance with strong correlations between position and rotation.
Matrix6 CorrelatedCovariance() {
  Matrix6 root = Matrix6::Zero();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) root(row, column) = row == column ? 1 : 0.4;
  }
  Vector6 scale;
  scale << 0.1, 0.2, 0.3, 0.01, 0.02, 0.03;
  root = scale.asDiagonal() * root;
  return root * root.transpose();
}

// Returns runs whose errors are drawn from the covariance that they state, times `scale`;
// neighbouring NIS values have `correlation`.
std::vector<RunErrors> DrawRuns(int num_runs, double scale, double correlation = 0) {
  const Matrix6 cov = CorrelatedCovariance();
  const Matrix6 root = cov.llt().matrixL();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<RunErrors> runs;
  for (int run = 0; run < num_runs; ++run) {
    RunErrors& errors = runs.emplace_back();
    errors.name = "run";
    double slow = 0;
    for (int i = 0; i < 200; ++i) {
      RunInstant instant;
      Vector6 noise;
      for (double& entry : noise) entry = normal(random);
      instant.time_s = 0.1 * i;
      instant.error = scale * root * noise;
      instant.cov = instant.cov_world = cov;
      instant.rotation_error_world = instant.error.tail<3>();
      errors.instants.push_back(instant);
      slow = correlation * slow + normal(random);
      errors.nis.push_back({0.1 * i, noise.squaredNorm() + 3 * correlation * slow});
    }
  }
  return runs;
}

TEST(JudgeConsistency, HonestErrorsLieInsideTheBands) {
  const Consistency c = JudgeConsistency(DrawRuns(50, 1.0));
  for (const BandedSeries* series : {&c.pose, &c.position, &c.rotation, &*c.nis}) {
    EXPECT_NEAR(series->average_per_dof, 1.0, 0.03);
    EXPECT_NEAR(series->end_average_per_dof, 1.0, 0.06);
    EXPECT_GT(series->share_in_band, 0.9);  // 95 % of 200 instants, minus 3 sigma
    EXPECT_EQ(series->time_s.size(), 200u);
  }
  EXPECT_NEAR(c.horizontal_m.predicted / c.horizontal_m.real, 1, 0.02);
  EXPECT_NEAR(c.yaw_deg.predicted / c.yaw_deg.real, 1, 0.02);
  EXPECT_GT(c.nis_whiteness->share_in_band, 0.79);
}

TEST(JudgeConsistency, SigmaSharesOfGaussianErrors) {
  const Consistency c = JudgeConsistency(DrawRuns(50, 1.0));
  for (const SigmaShares& shares : c.sigma_shares) {
    EXPECT_NEAR(shares[0], 0.6827, 0.02);
    EXPECT_NEAR(shares[1], 0.9545, 0.01);
    EXPECT_NEAR(shares[2], 0.9973, 0.003);
  }
}

TEST(JudgeConsistency, ErrorsTwiceTooLargeAreFourTimesOverConfident) {
  const Consistency c = JudgeConsistency(DrawRuns(20, 2.0));
  EXPECT_NEAR(c.pose.average_per_dof, 4.0, 0.1);
  EXPECT_EQ(c.pose.share_in_band, 0.0);
  EXPECT_NEAR(c.tilt_deg.predicted / c.tilt_deg.real, 0.5, 0.01);
}

TEST(JudgeConsistency, ErrorsOfHalfTheSizeAreOutsideToo) {
  const Consistency c = JudgeConsistency(DrawRuns(20, 0.5));
  EXPECT_NEAR(c.pose.average_per_dof, 0.25, 0.01);
  EXPECT_EQ(c.pose.share_in_band, 0.0);
}

TEST(JudgeConsistency, CorrelatedInnovationsAreNotWhite) {
  const Consistency c = JudgeConsistency(DrawRuns(20, 1.0, 0.8));
  EXPECT_GT(c.nis_whiteness->autocorrelation[0], 0.3);
  EXPECT_LT(c.nis_whiteness->share_in_band, 0.8);
}

// One run has one instant of known NEES: e' P^-1 e with P = diag(4), e = (2, 4, 0, 0, 0, 6).
TEST(JudgeConsistency, NeesByHand) {
  RunErrors run;
  RunInstant instant;
  instant.error << 2, 4, 0, 0, 0, 6;
  instant.cov = instant.cov_world = 4 * Matrix6::Identity();
  instant.rotation_error_world = instant.error.tail<3>();
  run.instants = {instant};
  const Consistency c = JudgeConsistency({run});
  EXPECT_NEAR(c.pose.average_per_dof, (1 + 4 + 9) / 6.0, 1e-12);
  EXPECT_NEAR(c.position.average_per_dof, 5 / 3.0, 1e-12);
  EXPECT_NEAR(c.rotation.average_per_dof, 9 / 3.0, 1e-12);
  EXPECT_EQ(c.sigma_shares[0], (SigmaShares{1, 1, 1}));
  EXPECT_EQ(c.sigma_shares[1], (SigmaShares{0, 1, 1}));
  EXPECT_EQ(c.sigma_shares[5], (SigmaShares{0, 0, 1}));
  EXPECT_FALSE(c.nis.has_value());
  EXPECT_THAT(c.notes, Contains(HasSubstr("no NIS")));
}

TEST(JudgeConsistency, EachRunHasItsLargestTilt) {
  std::vector<RunErrors> runs = DrawRuns(2, 1.0);
  runs[0].tilts = {{0.0, 1.0}, {0.1, 2.5}, {0.2, 2.0}};
  const Consistency c = JudgeConsistency(runs);
  ASSERT_EQ(c.run_largest_tilt.size(), 2u);
  EXPECT_EQ(c.run_largest_tilt[0]->sigmas, 2.5);
  EXPECT_EQ(c.run_largest_tilt[0]->time_s, 0.1);
  EXPECT_FALSE(c.run_largest_tilt[1]) << "there is no tilt to judge";
}

TEST(JudgeConsistency, BandsFollowTheRunsThatAreThere) {
  std::vector<RunErrors> runs = DrawRuns(4, 1.0);
  runs[3].instants.resize(100);
  const Consistency c = JudgeConsistency(runs);
  EXPECT_NEAR(c.pose.band_per_dof[50].low, MeanBandPerDof(6, 4).low, 1e-12);
  EXPECT_NEAR(c.pose.band_per_dof[150].low, MeanBandPerDof(6, 3).low, 1e-12);
}

}  // namespace
}  // namespace lio
