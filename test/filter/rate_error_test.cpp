// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/rate_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lio {
namespace {

constexpr double kInterval_s = 0.1;
constexpr double kMatchStd_rad = 2e-4;

// Poses after turns at `rate_radps`, by a gyro that is off by `ratio` of it, drawn for each turn.
// Returns the mean of |residual|^2 over its expected value for the later half.
double RunTurns(RateError& error, double rate_radps, double ratio, int num_poses,
                std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3{normal(random), normal(random), normal(random)}; };
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < num_poses; ++i) {
    const double variance_before = error.Psd(rate_radps) * kInterval_s;
    error.Turn(rate_radps, kInterval_s);
    const double turn_rad = rate_radps * kInterval_s;
    const Vector3 residual = kMatchStd_rad * vector() + ratio * turn_rad * vector();
    const double var = kMatchStd_rad * kMatchStd_rad + variance_before;
    if (2 * i >= num_poses) {
      sum += residual.squaredNorm() / (3.0 * var);
      ++count;
    }
    error.AddPose(residual, var * Matrix3::Identity());
    error.BeginTurn();
  }
  return count == 0 ? 0.0 : sum / count;
}

TEST(RateError, BeforeAnyTurnItIsThatOfAnIndustrialUnit) {
  EXPECT_DOUBLE_EQ(RateError().std_ratio(), RateErrorParameters{}.prior_std_ratio);
}

TEST(RateError, TheRatioIsLearnedFromFastTurnsAndTheInnovationIsThenConsistent) {
  RateError error;
  const double consistency = RunTurns(error, 4.0, 5e-3, 400);
  EXPECT_NEAR(error.std_ratio(), 5e-3, 1.5e-3);
  EXPECT_NEAR(consistency, 1.0, 0.25);
}

TEST(RateError, AnExactGyroIsFoundToBeExact) {
  RateError error;
  RunTurns(error, 4.0, 0.0, 400);
  EXPECT_LT(error.std_ratio(), 5e-4);  // a match that is off by its sigma, over one turn of 0.4 rad
}

// A residual that is not of the gyro, five sigma of a match, teaches little on slow turns.
TEST(RateError, SlowTurnsTeachNothing) {
  RateError error;
  for (int i = 0; i < 100; ++i) {
    error.Turn(0.1, kInterval_s);
    error.AddPose(Vector3(1e-3, 0, 0), 1e-8 * Matrix3::Identity());
    error.BeginTurn();
  }
  EXPECT_NEAR(error.std_ratio(), RateErrorParameters{}.prior_std_ratio, 3e-4);
}

TEST(RateError, AWrongMatchCountsForNoMoreThanTheWorstUnit) {
  RateError error;
  for (int i = 0; i < 100; ++i) {
    error.Turn(5.0, kInterval_s);
    error.AddPose(Vector3(1.0, 0, 0), 1e-8 * Matrix3::Identity());
    error.BeginTurn();
  }
  EXPECT_LE(error.std_ratio(), RateErrorParameters{}.max_std_ratio);
}

// A pose after a gap is unsure by half a turn, whatever its residual is.
TEST(RateError, APoseThatIsUnsureTeachesNothing) {
  RateError error;
  RunTurns(error, 4.0, 5e-3, 400);
  const double before = error.std_ratio();
  for (int i = 0; i < 20; ++i) {
    error.Turn(4.0, kInterval_s);
    error.AddPose(Vector3::Zero(), 0.05 * 0.05 * Matrix3::Identity());
    error.BeginTurn();
  }
  EXPECT_NEAR(error.std_ratio(), before, 0.02 * before);
}

TEST(RateError, AFirstPoseThatIsUnsureTeachesNothing) {
  RateError error;
  error.Turn(0.2, kInterval_s);
  error.AddPose(Vector3::Zero(), 0.25 * Matrix3::Identity());
  EXPECT_NEAR(error.std_ratio(), RateErrorParameters{}.prior_std_ratio, 1e-6);
}

TEST(RateError, AnotherHistoryBeginsWithWhatWasLearnedAndNoTurn) {
  RateError error;
  RunTurns(error, 4.0, 5e-3, 400);
  RateError anew = error;
  anew.Turn(10.0, 1.0);
  anew = anew.Anew();
  EXPECT_DOUBLE_EQ(anew.std_ratio(), error.std_ratio());
  anew.AddPose(Vector3(0.1, 0, 0), 1e-8 * Matrix3::Identity());  // without a turn
  EXPECT_DOUBLE_EQ(anew.std_ratio(), error.std_ratio());
}

TEST(RateError, AnotherErrorIsFollowed) {
  RateError error;
  RunTurns(error, 4.0, 2e-2, 200);
  RunTurns(error, 4.0, 1e-3, 400, 2);
  EXPECT_LT(error.std_ratio(), 3e-3);
}

// White noise of Psd() has, at the next pose, the variance of an error that lasts the interval.
TEST(RateError, TheNoiseHasTheErrorsVarianceAtTheNextPose) {
  RateError error;
  error.Turn(1.0, 0.05);
  error.BeginTurn();  // poses come every 50 ms
  EXPECT_NEAR(error.Psd(2.0) * 0.05, std::pow(error.std_ratio() * 2.0 * 0.05, 2), 1e-15);
}

// A turn over two intervals, since a pose was refused, is one turn with one error.
TEST(RateError, ATurnGoesOnWhereAPoseWasRefused) {
  RateError once;
  RateError twice;
  once.Turn(4.0, 2.0 * kInterval_s);
  twice.Turn(4.0, kInterval_s);
  twice.Turn(4.0, kInterval_s);
  const Matrix3 cov = 1e-5 * Matrix3::Identity();
  once.AddPose(Vector3(0.01, 0, 0), cov);
  twice.AddPose(Vector3(0.01, 0, 0), cov);
  EXPECT_DOUBLE_EQ(once.std_ratio(), twice.std_ratio());
}

}  // namespace
}  // namespace lio
