// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/sensor_fixed_errors.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/random_state.hpp"

namespace lio {
namespace {

constexpr std::size_t kNumDirections = 20;

// A match with a score of each beam direction.
MatchResult Match(std::vector<Vector6> scores) {
  MatchResult match;
  match.beam_scores = std::move(scores);
  match.shift_per_score = 1e-3 * Matrix6::Identity();
  return match;
}

MatchResult RandomMatch(std::mt19937_64& random) {
  std::vector<Vector6> scores(kNumDirections);
  for (Vector6& score : scores) score = test::RandomVector<6>(random);
  return Match(scores);
}

TEST(SensorFixedErrors, NothingIsKnownBeforeTheFirstScores) {
  std::mt19937_64 random(1);
  SensorFixedErrors errors;
  EXPECT_TRUE(errors.CovOf(RandomMatch(random)).isZero(0.0));
  errors.Add(Match({}));
  EXPECT_TRUE(errors.CovOf(RandomMatch(random)).isZero(0.0));
}

TEST(SensorFixedErrors, ScoresThatStayTheSameAreWhollyOfTheSensor) {
  std::mt19937_64 random(1);
  const MatchResult match = RandomMatch(random);
  Matrix6 expected = Matrix6::Zero();
  for (const Vector6& score : match.beam_scores) expected += 1e-6 * score * score.transpose();
  SensorFixedErrors errors;
  for (int i = 0; i < 200; ++i) errors.Add(match);
  EXPECT_LT((errors.CovOf(match) - expected).norm(), 1e-12 * expected.norm());
}

// The same errors shift a match more that has fewer points to hold it.
TEST(SensorFixedErrors, ACovarianceIsThatOfTheMatchAtHand) {
  std::mt19937_64 random(4);
  MatchResult match = RandomMatch(random);
  SensorFixedErrors errors;
  errors.Add(match);
  const Matrix6 cov = errors.CovOf(match);
  match.shift_per_score.row(0).setZero();
  match.shift_per_score(1, 1) *= 3.0;
  const Matrix6 other = errors.CovOf(match);
  EXPECT_EQ(other(0, 0), 0.0);
  EXPECT_NEAR(other(1, 1), 9.0 * cov(1, 1), 1e-12 * other(1, 1));
  EXPECT_NEAR(other(1, 2), 3.0 * cov(1, 2), 1e-12 * other(1, 1));
}

TEST(SensorFixedErrors, NoiseLeavesItsSquareOverTheScansOfTheMean) {
  std::mt19937_64 random(2);
  SensorFixedErrors errors;
  double sum = 0.0;
  constexpr int kScans = 4000;
  for (int i = 0; i < kScans; ++i) {
    const MatchResult match = RandomMatch(random);
    errors.Add(match);
    if (i >= kScans / 2) sum += errors.CovOf(match).trace() / (kScans / 2);
  }
  double of_one_scan = 0.0;
  for (int i = 0; i < kScans; ++i) {
    for (const Vector6& score : RandomMatch(random).beam_scores) {
      of_one_scan += 1e-6 * score.squaredNorm() / kScans;
    }
  }
  // An exponential mean with weight 1/50 has 1/99 of the variance of one.
  EXPECT_NEAR(sum / of_one_scan, 1.0 / 99.0, 0.1 / 99.0);
}

TEST(SensorFixedErrors, OtherErrorsAreFollowed) {
  std::mt19937_64 random(3);
  const MatchResult before = RandomMatch(random);
  SensorFixedErrors errors;
  for (int i = 0; i < 500; ++i) errors.Add(before);
  const double trace_before = errors.CovOf(before).trace();
  const MatchResult none = Match(std::vector<Vector6>(kNumDirections, Vector6::Zero()));
  for (int i = 0; i < 250; ++i) errors.Add(none);
  EXPECT_LT(errors.CovOf(before).trace(), 1e-4 * trace_before);
  errors.Reset();
  EXPECT_TRUE(errors.CovOf(before).isZero(0.0));
}

}  // namespace
}  // namespace lio
