// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "calib/rate_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/sensor_pair.hpp"

namespace lio {
namespace {

using test::BiasedSamples;
using test::kExtrinsic;
using test::LookAbout;
using test::TurnAboutZ;

constexpr double kClockBehind_s = 0.0734;

// Returns turns of 0.1 s of a lidar whose clock is kClockBehind_s behind.
std::vector<LidarTurn> LidarTurns(const test::Motion& motion, double from_s, double to_s) {
  std::vector<LidarTurn> turns;
  for (double t_s = from_s; t_s < to_s - 0.05; t_s += 0.1) {
    const auto at = [&](double t) { return motion(t + kClockBehind_s).rotation * kExtrinsic; };
    turns.push_back({test::StampAt(t_s), test::StampAt(t_s + 0.1),
                     LogSo3(at(t_s).conjugate() * at(t_s + 0.1))});
  }
  return turns;
}

TEST(RateSearch, FindsOffsetRotationAndBias) {
  const auto samples = BiasedSamples(LookAbout, 12.0);
  const auto turns = LidarTurns(LookAbout, 1.0, 10.0);
  const RateMatch match = RateSearch(samples, turns).Run(0.5);
  EXPECT_EQ(match.num_turns, 90);
  EXPECT_NEAR(match.offset_s, kClockBehind_s, 1e-3);
  EXPECT_LT(LogSo3(Quaternion(match.R_imu_lidar).conjugate() * kExtrinsic).norm(), 0.02);
  EXPECT_LT((match.gyro_bias_radps - test::kGyroBias).norm(), 2e-3);
  EXPECT_GT(match.correlation, 0.998);
  EXPECT_LE(match.correlation, 1.0 + 1e-12);
  EXPECT_GT(match.second_axis_ratio, 0.1);
}

TEST(RateSearch, WrongOffsetsAgreeLess) {
  const auto samples = BiasedSamples(LookAbout, 12.0);
  const auto turns = LidarTurns(LookAbout, 1.0, 10.0);
  const RateSearch search(samples, turns);
  const double right = search.At(kClockBehind_s).correlation;
  for (const double error_s : {-0.3, -0.05, -0.01, 0.01, 0.05, 0.3}) {
    EXPECT_LT(search.At(kClockBehind_s + error_s).correlation, right) << error_s;
  }
}

// The swing of 2 rad/s about z with amplitude 1 has rates of 2 cos(2 t), rms sqrt(2) over whole
// periods.
TEST(RateSearch, RateAboutItsMeanAndTheMissingSecondAxisAreTold) {
  const auto samples = BiasedSamples(TurnAboutZ, 12.0);
  const auto turns = LidarTurns(TurnAboutZ, 0.5, 0.5 + 3.0 * M_PI);
  const RateMatch match = RateSearch(samples, turns).At(kClockBehind_s);
  EXPECT_NEAR(match.gyro_rate_rms_radps, std::sqrt(2.0), 0.02);
  EXPECT_LT(match.second_axis_ratio, 1e-6);
  EXPECT_NEAR(match.correlation, 1.0, 1e-4);
}

// The turns are mirrored: the best rotation is no reflection, and agrees less.
TEST(RateSearch, MirroredTurnsGiveARotationAllTheSame) {
  const auto samples = BiasedSamples(LookAbout, 12.0);
  auto turns = LidarTurns(LookAbout, 1.0, 10.0);
  for (LidarTurn& turn : turns) turn.rotation_lidar = -turn.rotation_lidar;
  const RateMatch match = RateSearch(samples, turns).At(kClockBehind_s);
  EXPECT_NEAR(match.R_imu_lidar.determinant(), 1.0, 1e-12);
  EXPECT_LT(match.correlation, 0.99);
}

TEST(RateSearch, TurnsAcrossAHoleOrOutsideTheSamplesAreLeftOut) {
  auto samples = BiasedSamples(LookAbout, 8.0);
  const auto turns = LidarTurns(LookAbout, 0.0, 10.0);
  const int num_whole = RateSearch(samples, turns).At(0.0).num_turns;
  EXPECT_NEAR(num_whole, 80, 1);  // 100 are offered; the last may end just where the samples do
  std::erase_if(samples, [](const ImuSample& s) {
    const double t_s = test::SecondsOf(s.stamp);
    return t_s > 3.02 && t_s < 3.18;
  });
  // These are the turns from 3.0 to 3.1 s and from 3.1 to 3.2 s.
  EXPECT_EQ(RateSearch(samples, turns).At(0.0).num_turns, num_whole - 2);
}

TEST(RateSearch, FewTurnsAreOnlyCounted) {
  const auto samples = BiasedSamples(LookAbout, 12.0);
  const auto turns = LidarTurns(LookAbout, 1.0, 2.9);
  const RateMatch match = RateSearch(samples, turns).At(kClockBehind_s);
  EXPECT_EQ(match.num_turns, 19);
  EXPECT_EQ(match.correlation, 0.0);
}

TEST(RateSearch, NothingComesOfNothing) {
  const RateMatch match = RateSearch({}, LidarTurns(LookAbout, 1.0, 10.0)).Run(0.1);
  EXPECT_EQ(match.num_turns, 0);
  EXPECT_EQ(match.correlation, 0.0);
  EXPECT_TRUE(match.R_imu_lidar.isIdentity());
}

}  // namespace
}  // namespace lio
