// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/sensor_fixed_errors.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/random_state.hpp"

namespace lio {
namespace {

constexpr std::size_t kNumDirections = 20;
constexpr double kShare = 0.05;

// Returns a match with a score of each beam direction.
MatchResult Match(std::vector<Vector6> scores) {
  MatchResult match;
  match.beam_pull.scores = std::move(scores);
  match.shift_per_score = 1e-3 * Matrix6::Identity();
  match.new_content_share = kShare;
  return match;
}

MatchResult RandomMatch(std::mt19937_64& random) {
  std::vector<Vector6> scores(kNumDirections);
  for (Vector6& score : scores) score = test::RandomVector<6>(random);
  return Match(scores);
}

SensorFixedErrors ErrorsAfter(const MatchResult& match) {
  SensorFixedErrors errors;
  errors.Add(match);
  return errors;
}

TEST(SensorFixedErrors, NothingIsKnownBeforeTheFirstScores) {
  std::mt19937_64 random(1);
  SensorFixedErrors errors;
  EXPECT_TRUE(errors.CovPerReplacement(RandomMatch(random)).isZero(0.0));
  errors.Add(Match({}));
  EXPECT_TRUE(errors.CovPerReplacement(RandomMatch(random)).isZero(0.0));
}

// The drift after N replacements is N times the shift of one match, so the sum over the scans is
// its square.
TEST(SensorFixedErrors, ScoresThatStayTheSameAddUpToADriftInProportionToTheNewContent) {
  std::mt19937_64 random(1);
  const MatchResult match = RandomMatch(random);
  Matrix6 of_one_match = Matrix6::Zero();
  for (const Vector6& score : match.beam_pull.scores)
    of_one_match += 1e-6 * score * score.transpose();
  SensorFixedErrors errors;
  Matrix6 sum = Matrix6::Zero();
  constexpr int kScans = 2000;
  for (int i = 0; i < kScans; ++i) {
    errors.Add(match);
    sum += kShare * errors.CovPerReplacement(match);
  }
  constexpr double kReplacements = kScans * kShare;
  const Matrix6 expected = kReplacements * kReplacements * of_one_match;
  EXPECT_LT((sum - expected).norm(), 1e-3 * expected.norm());
}

TEST(SensorFixedErrors, WithBeamsThatAreCalibratedItIsTheMeanOfScoresAndOfWhatIsLeft) {
  std::mt19937_64 random(1);
  MatchResult match = RandomMatch(random);
  const SensorFixedErrors errors = ErrorsAfter(match);
  const Matrix6 of_scores = errors.CovPerReplacement(match);
  match.beam_pull.unknown_cov = 3.0 * Matrix6::Identity();
  const Matrix6 of_both = errors.CovPerReplacement(match);
  const Matrix6 of_left = 2.0 * kShare * 1e-6 * *match.beam_pull.unknown_cov;
  EXPECT_LT((of_both - 0.5 * (of_scores + of_left)).norm(), 1e-9 * of_both.norm());
}

// The same errors shift a match more that has fewer points to hold it.
TEST(SensorFixedErrors, ACovarianceIsThatOfTheMatchAtHand) {
  std::mt19937_64 random(4);
  MatchResult match = RandomMatch(random);
  const SensorFixedErrors errors = ErrorsAfter(match);
  const Matrix6 cov = errors.CovPerReplacement(match);
  match.shift_per_score.row(0).setZero();
  match.shift_per_score(1, 1) *= 3.0;
  const Matrix6 other = errors.CovPerReplacement(match);
  EXPECT_EQ(other(0, 0), 0.0);
  EXPECT_NEAR(other(1, 1), 9.0 * cov(1, 1), 1e-12 * other(1, 1));
  EXPECT_NEAR(other(1, 2), 3.0 * cov(1, 2), 1e-12 * other(1, 1));
}

// Scores that are new in each scan are a random walk of the map: its variance per scan is share^2
// times theirs, and twice that is said.
TEST(SensorFixedErrors, ScoresOfNoiseAreARandomWalk) {
  std::mt19937_64 random(2);
  SensorFixedErrors errors;
  double sum = 0.0;
  double of_one_scan = 0.0;
  constexpr int kScans = 4000;
  for (int i = 0; i < kScans; ++i) {
    const MatchResult match = RandomMatch(random);
    for (const Vector6& score : match.beam_pull.scores)
      of_one_scan += 1e-6 * score.squaredNorm() / kScans;
    errors.Add(match);
    sum += errors.CovPerReplacement(match).trace() / kScans;
  }
  // The mean over the drive is one draw of 120 numbers, whose square is good to 13 %: three sigma.
  EXPECT_NEAR(sum / (2.0 * kShare * of_one_scan), 1.0, 0.4);
}

TEST(SensorFixedErrors, ScoresThatChangeSignCancel) {
  std::mt19937_64 random(3);
  const MatchResult match = RandomMatch(random);
  MatchResult opposite = match;
  for (Vector6& score : opposite.beam_pull.scores) score = -score;
  SensorFixedErrors errors;
  for (int i = 0; i < 100; ++i) errors.Add(match);
  const double before = errors.CovPerReplacement(match).trace();
  for (int i = 0; i < 100; ++i) errors.Add(opposite);
  EXPECT_LT(errors.CovPerReplacement(match).trace(), 1e-9 * before);
}

TEST(SensorFixedErrors, AScanThatBringsNothingNewCountsForNothing) {
  std::mt19937_64 random(5);
  MatchResult match = RandomMatch(random);
  match.new_content_share = 0.0;
  SensorFixedErrors errors;
  errors.Add(match);
  EXPECT_TRUE(errors.CovPerReplacement(match).isZero(0.0));
}

// P of a new map is zero, and what the sensor's errors are is known: the drift begins anew.
TEST(SensorFixedErrors, InANewMapTheDriftBeginsAnewWithWhatIsKnownOfTheErrors) {
  std::mt19937_64 random(7);
  const MatchResult match = RandomMatch(random);
  SensorFixedErrors errors;
  for (int i = 0; i < 100; ++i) errors.Add(match);
  const Matrix6 after_100 = errors.CovPerReplacement(match);
  errors.BeginMap();
  EXPECT_TRUE(errors.CovPerReplacement(match).isZero(0.0));
  errors.Add(RandomMatch(random));
  const Matrix6 after_one = errors.CovPerReplacement(match);
  EXPECT_NEAR(after_one.trace(), 0.01 * after_100.trace(), 0.001 * after_100.trace());
}

// A score is the gradient of the cost by the pose of the imu: a turn of the new imu moves the old.
TEST(SensorFixedErrors, AnotherExtrinsicKeepsTheErrorsAsThoseOfTheNewImu) {
  std::mt19937_64 random(8);
  const Pose T_old_new = ExpSe3(test::RandomVector<6>(random));
  const MatchResult of_old = RandomMatch(random);
  MatchResult of_new = of_old;
  for (Vector6& score : of_new.beam_pull.scores) {
    const Vector6 of_old_imu = score;
    for (int axis = 0; axis < 6; ++axis) {
      constexpr double kStep = 1e-3;
      const Pose moved_old = T_old_new * ExpSe3(kStep * Vector6::Unit(axis)) * T_old_new.Inverse();
      score[axis] = of_old_imu.dot(LogSe3(moved_old)) / kStep;
    }
  }
  SensorFixedErrors errors = ErrorsAfter(of_old);
  errors.SetImu(T_old_new);
  const Matrix6 expected = ErrorsAfter(of_new).CovPerReplacement(of_new);
  EXPECT_LT((errors.CovPerReplacement(of_new) - expected).norm(), 1e-9 * expected.norm());
}

}  // namespace
}  // namespace lio
