// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/match_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

// --- a term

TEST(JacobianRow, IsTheDerivativeByTheRightPerturbation) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20; ++i) {
    const Vector3 p = 10.0 * test::RandomVector<3>(random);
    const Vector3 n_map = test::RandomVector<3>(random).normalized();
    const Pose T = ExpSe3(test::RandomVector<6>(random));
    const auto along = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, n_map.dot(T * ExpSe3(Vector6(d)) * p));
    };
    const Eigen::MatrixXd numeric = test::NumericJacobian(along, Vector6::Zero());
    const Vector3 n_imu = T.rotation.conjugate() * n_map;
    const Vector6f row = JacobianRow(p.cast<float>(), n_imu.cast<float>());
    EXPECT_LT((row.cast<double>() - numeric.transpose()).norm(), 1e-5);
  }
}

TEST(RobustKernel, WeighsByGemanAndMcClure) {
  EXPECT_EQ(RobustKernel(0.f).weight(), 1.f);
  EXPECT_EQ(RobustKernel(0.f).curvature(), 1.f);
  EXPECT_FLOAT_EQ(RobustKernel(8.f).weight(), 0.25f);
  EXPECT_FLOAT_EQ(RobustKernel(24.f).weight(), 1.f / 16.f);
  EXPECT_EQ(RobustKernel().weight(), 0.f);
}

// The curvature is d(w d)/dd over w.
TEST(RobustKernel, CurvatureIsThatOfTheRobustCost) {
  for (const float d : {0.3f, 1.f, 1.6f, 3.f, 5.f}) {
    const auto pull = [](float x) { return RobustKernel(x * x).weight() * x; };
    const float slope = (pull(d + 1e-2f) - pull(d - 1e-2f)) / 2e-2f;
    const RobustKernel kernel(d * d);
    EXPECT_NEAR(kernel.curvature(), slope / kernel.weight(), 2e-3f) << d;
  }
}

TEST(TermSum, SumsWeightedSquaresOfRows) {
  Vector6f a, b;
  a << 1, 2, 3, 4, 5, 6;
  b << 0, 1, 0, -1, 0, 2;
  TermSum sum;
  sum.Add(a, 2.f);
  sum.Add(b, 0.5f);
  const Vector6 ad = a.cast<double>(), bd = b.cast<double>();
  EXPECT_EQ(sum.Full(), Matrix6(2.0 * ad * ad.transpose() + 0.5 * bd * bd.transpose()));
}

TEST(MatchSums, ARowGoesIntoEverySum) {
  Vector6f row;
  row << 1, 0, 0, 0, 2, 0;
  MatchSums sums;
  const RobustKernel kernel(8.f);  // weight 1/4, curvature -1
  const Vector6f gradient = sums.AddRow(row, 0.5f, 100.f, kernel);
  Vector6 expected;
  expected << 50, 0, 0, 0, 100, 0;  // weight times residual times row
  EXPECT_EQ(gradient.cast<double>(), expected);
  EXPECT_EQ(sums.gradient, expected);
  EXPECT_EQ(sums.information.Full()(4, 0), 200.0);
  EXPECT_EQ(sums.information.Full()(0, 4), 200.0);
  EXPECT_FLOAT_EQ(static_cast<float>(sums.weight_sum), 0.25f);
  EXPECT_FLOAT_EQ(static_cast<float>(sums.residual_sq_sum), 0.25f * 0.25f);
  EXPECT_FLOAT_EQ(static_cast<float>(sums.curvature_sum), -100.f);
  EXPECT_FLOAT_EQ(static_cast<float>(sums.information_sum), 100.f);
}

// --- the summary

// Three walls, 50 terms each, seen from 5 m: every direction is observable.
MatchSums HeldSums(int num_axes, float residual_m) {
  MatchSums sums;
  std::mt19937_64 random(4);
  for (int i = 0; i < 50 * num_axes; ++i) {
    const Eigen::Vector3f p = 5.f * test::RandomVector<3>(random).cast<float>();
    const Eigen::Vector3f normal = Eigen::Vector3f::Unit(i % num_axes);
    sums.AddRow(JacobianRow(p, normal), residual_m, 1000.f, RobustKernel(0.f));
    for (int axis = 0; axis < 3; ++axis) {  // normals known to a hundredth
      if (normal[axis] == 0.f) {
        sums.noise_information.Add(JacobianRow(p, Eigen::Vector3f::Unit(axis)), 1000.f * 1e-4f);
      }
    }
    ++sums.num_matched;
  }
  return sums;
}

TEST(Summarise, CovarianceIsTheSandwichWhereAllIsObservable) {
  const MatchSums sums = HeldSums(3, 0.02f);
  MatchResult result;
  result.status = MatchStatus::kConverged;
  const Matrix6 score_cov = 3.0 * sums.information.Full();
  const Vector6 step = Summarise(sums, score_cov, result).last_step;
  EXPECT_EQ(result.information, sums.information.Full());
  const Matrix6 inverse = sums.information.Full().inverse();
  EXPECT_LT((result.cov - 3.0 * inverse).norm(), 1e-9 * result.cov.norm() + 1e-15);
  EXPECT_LT((result.observable_cov - result.cov).norm(), 1e-15);
  EXPECT_LT((step + inverse * sums.gradient).norm(), 1e-9);
  EXPECT_NEAR(result.residual_rms_m, 0.02, 1e-7);
  EXPECT_EQ(result.degenerate_mask, 0u);
  EXPECT_EQ(result.status, MatchStatus::kConverged);
  EXPECT_GT(result.eigenvalues[0], 0.0);
}

// Half the curvature gives four times the covariance. A ratio below 0.3 counts as 0.3.
TEST(Summarise, WhatTheKernelTakesOfTheCurvatureWidensTheCovariance) {
  MatchSums sums = HeldSums(3, 0.02f);
  const Matrix6 score_cov = sums.information.Full();
  const auto variance_at = [&](double curvature) {
    sums.curvature_sum = curvature * sums.information_sum;
    MatchResult result;
    (void)Summarise(sums, score_cov, result);
    return result.cov(0, 0);
  };
  EXPECT_NEAR(variance_at(0.5) / variance_at(1.0), 4.0, 1e-9);
  EXPECT_NEAR(variance_at(-2.0) / variance_at(1.0), 1.0 / 0.09, 1e-9);
  EXPECT_NEAR(variance_at(1.5) / variance_at(1.0), 1.0, 1e-9);
}

// Two walls: nothing holds along z.
TEST(Summarise, ADirectionThatNothingConstrainsIsDegenerate) {
  const MatchSums sums = HeldSums(2, 0.02f);
  MatchResult result;
  result.status = MatchStatus::kConverged;
  const Vector6 step = Summarise(sums, sums.information.Full(), result).last_step;
  EXPECT_EQ(result.degenerate_mask, 1u);
  EXPECT_EQ(result.status, MatchStatus::kDegenerate);
  EXPECT_NEAR(std::sqrt(result.cov(2, 2)), 100.0, 0.1);
  EXPECT_LT(std::sqrt(result.observable_cov(2, 2)), 1e-6);
  EXPECT_LT(std::sqrt(result.cov(0, 0)), 0.1);
  EXPECT_NEAR(step[2], 0.0, 1e-9);
}

TEST(Summarise, OtherStatesThanConvergedAreKept) {
  MatchResult result;
  result.status = MatchStatus::kMaxIterations;
  const MatchSums sums = HeldSums(2, 0.02f);
  (void)Summarise(sums, sums.information.Full(), result);
  EXPECT_EQ(result.status, MatchStatus::kMaxIterations);
  EXPECT_NE(result.degenerate_mask, 0u);
}

TEST(FinishMatch, FewTermsAreToldWithTheirNumberAlone) {
  MatchResult result;
  result.status = MatchStatus::kConverged;
  MatchScores none;
  FinishMatch(HeldSums(3, 0.02f), none, false, result);
  EXPECT_EQ(result.status, MatchStatus::kTooFewPoints);
  EXPECT_EQ(result.num_matched, 150);
  EXPECT_EQ(result.information, Matrix6::Zero());
}

TEST(FinishMatch, EnoughTermsGiveTheSummaryAndTheLastStep) {
  const MatchSums sums = HeldSums(3, 1e-5f);
  MatchScores scores;
  scores.Reset(20, Pose::Identity());
  for (int part = 0; part < 20; ++part) {
    scores.Add({5.f, 0.f, 0.f}, {part, 1.f, Vector6f::Zero(), Vector6f::Unit(part % 6)});
  }
  MatchResult result;
  result.status = MatchStatus::kConverged;
  FinishMatch(sums, scores, true, result);
  MatchResult expected;
  expected.status = MatchStatus::kConverged;
  TakeLastStep(Summarise(sums, scores.Covariance(), expected).last_step, expected);
  EXPECT_EQ(result.status, MatchStatus::kConverged);
  EXPECT_EQ(result.cov, expected.cov);
  EXPECT_GT(result.T_map_imu.translation.norm(), 0.0);
  EXPECT_EQ(result.T_map_imu.translation, expected.T_map_imu.translation);
  EXPECT_FALSE(result.beam_pull.scores.empty());
}

// Two walls along x, whose normals lean by 10 mrad either way: a metre along x moves the pose by as
// much across, to one side or to the other.
TEST(MatchScores, ABlindDirectionVariesByTheLeaningOfTheNormals) {
  constexpr float kLean = 0.01f;
  constexpr int kParts = 100;
  MatchScores scores;
  scores.Reset(kParts, Pose::Identity());
  for (int part = 0; part < kParts; ++part) {
    Vector6f row = Vector6f::Unit(1);
    row[0] = part % 2 == 0 ? kLean : -kLean;
    scores.Add({5.f, 0.f, 0.f}, {part, 1.f, row, Vector6f::Zero()});
  }
  MatchResult result;
  result.shift_per_score(1, 1) = 1.0 / kParts;  // a hundred rows have weight one
  result.blind_directions = {{Vector6::UnitX(), Vector6::UnitX()}};
  scores.Complete(1.0, result);
  const Matrix6& cov = result.blind_directions.front().cov;
  const double mean_var = kLean * kLean / kParts;
  EXPECT_NEAR(cov(1, 1), mean_var, 0.1 * mean_var);  // 100 / 94 by the dimensions
  EXPECT_EQ(cov(0, 0), 0.0);
}

// --- new content

// Ten points are inserted for each of the two that are matched.
double TenForEach() {
  static const std::vector<Eigen::Vector3f> points(20, Eigen::Vector3f::Zero());
  MatchInput input;
  input.points_imu = std::span(points).first(2);
  input.scan_points_imu = points;
  return InsertedPerMatched(input);
}

TEST(NewContentMean, IsTheMeanShareOfWhatVoxelsHoldAfter) {
  NewContentMean mean;
  mean.Add(0.0, TenForEach());
  EXPECT_EQ(mean.share(), 1.0);
  mean.Add(30.0, TenForEach());
  EXPECT_DOUBLE_EQ(mean.share(), 0.5 * (1.0 + 0.25));
}

TEST(NewContentMean, VoxelsThatTakeNoMoreHaveNothingNew) {
  NewContentMean mean;
  mean.Add(10.0, TenForEach());
  mean.AddFrozen();
  EXPECT_DOUBLE_EQ(mean.share(), 0.25);
}

TEST(NewContentMean, WhereNothingIsMatchedAllIsNew) {
  EXPECT_EQ(NewContentMean().share(), 1.0);
}

}  // namespace
}  // namespace lio
