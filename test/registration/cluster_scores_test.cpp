// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/cluster_scores.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

PoseScores::Score FirstScore(float x) {
  return x * PoseScores::Score::Unit(0);
}

TEST(ClusterScores, TermsOfOnePartAddBeforeTheyAreSquared) {
  PoseScores scores;
  scores.Reset(10);
  scores.Add(3, FirstScore(1.f));
  scores.Add(7, FirstScore(5.f));
  scores.Add(3, FirstScore(2.f));
  EXPECT_EQ(scores.SumOfSquares()(0, 0), 9.0 + 25.0);
  EXPECT_EQ(scores.SumOfSquares()(1, 1), 0.0);
}

// Ten parts and six estimated dimensions give 10 / 4. The factor of six or fewer is the number of
// parts.
TEST(ClusterScores, CovarianceMakesUpForTheEstimatedDimensions) {
  PoseScores scores;
  scores.Reset(10);
  for (int part = 0; part < 10; ++part) scores.Add(part, FirstScore(1.f));
  EXPECT_DOUBLE_EQ(scores.Covariance()(0, 0), 10.0 * 10.0 / 4.0);
  scores.Reset(10);
  for (int part = 0; part < 5; ++part) scores.Add(part, FirstScore(1.f));
  EXPECT_DOUBLE_EQ(scores.Covariance()(0, 0), 5.0 * 5.0);
}

TEST(ClusterScores, ResetForgetsAndMayGrowOrShrink) {
  PoseScores scores;
  scores.Reset(4);
  scores.Add(3, FirstScore(1.f));
  scores.Reset(100);
  EXPECT_EQ(scores.SumOfSquares(), PoseScores::Square(PoseScores::Square::Zero()));
  scores.Add(99, FirstScore(2.f));
  scores.Reset(4);
  scores.Add(3, FirstScore(3.f));
  EXPECT_EQ(scores.SumOfSquares()(0, 0), 9.0);
}

}  // namespace
}  // namespace lio
