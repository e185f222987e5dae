// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/run_tally.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

Timestamp At(double t_s) {
  return Timestamp{1'700'000'000'000'000'000} + Duration::FromSeconds(t_s);
}

// Input from 0 to 20 s; poses from `from_s` to `to_s`, every 0.1 s at 2 m/s.
RunTally Drive(double from_s, double to_s) {
  RunTally tally;
  for (int i = 0; i <= 200; ++i) {
    const double t_s = 0.1 * i;
    tally.AddImu(At(t_s));
    tally.AddSweep(At(t_s));
    if (t_s < from_s || t_s > to_s + 1e-9) continue;
    PoseRow row;
    row.stamp = At(t_s);
    row.is_located = true;
    row.T_map_imu.translation.x() = 2.0 * t_s;
    row.position_cov = 0.01 * Matrix3::Identity();
    row.rotation_cov = 1e-6 * Matrix3::Identity();
    row.imu_noise = {5.0, 1.0};
    tally.AddRow(row);
  }
  return tally;
}

TEST(RunTally, WholeDriveIsCoveredWithoutItsStart) {
  EXPECT_NEAR(Drive(2.0, 20.0).Coverage(), 1.0, 1e-9);
  EXPECT_NEAR(Drive(3.0, 20.0).Coverage(), 1.0, 1e-6);
}

TEST(RunTally, LostTimeIsNotCovered) {
  EXPECT_NEAR(Drive(0.0, 8.5).Coverage(), 0.5, 1e-6);
  EXPECT_EQ(RunTally().Coverage(), 0.0);
}

TEST(RunTally, JumpOfTheClocksIsNoTime) {
  RunTally tally = Drive(0.0, 20.0);
  tally.AddImu(At(100'000.0));
  EXPECT_NEAR(tally.Coverage(), 1.0, 1e-9);
}

TEST(RunTally, ClaimIsPerHundredMetres) {
  const ClaimedAccuracy claimed = Drive(0.0, 20.0).Claimed();
  ASSERT_TRUE(claimed.position_std_m_per_100m && claimed.tilt_std_deg);
  EXPECT_NEAR(*claimed.position_std_m_per_100m, std::sqrt(0.03) * 100.0 / 40.0, 1e-9);
  EXPECT_NEAR(*claimed.tilt_std_deg, std::sqrt(2e-6) * 180.0 / M_PI, 1e-9);
}

TEST(RunTally, ShortPathClaimsNothingPerHundredMetres) {
  EXPECT_FALSE(Drive(0.0, 2.0).Claimed().position_std_m_per_100m);
  EXPECT_FALSE(RunTally().Claimed().tilt_std_deg);
}

TEST(RunTally, MedianNoiseIsKnownToAFactorOfTwo) {
  EXPECT_EQ(Drive(0.0, 20.0).MedianNoise().gyro, 4.0);
  EXPECT_EQ(Drive(0.0, 20.0).MedianNoise().accel, 1.0);
  EXPECT_EQ(RunTally().MedianNoise().gyro, 0.0);
}

TEST(RunTally, AnImuOfTenHertzIsSlow) {
  for (const double rate_hz : {10.0, 20.0}) {
    RunTally tally;
    for (int i = 0; i < 50; ++i) tally.AddImu(At(i / rate_hz));
    EXPECT_EQ(tally.IsImuSlow(), rate_hz < 15.0) << rate_hz;
  }
}

TEST(RunTally, TellsTheLongestTimeForWhichTheWayWasGuessed) {
  RunTally tally;
  for (int i = 0; i <= 100; ++i) {
    PoseRow row;
    row.stamp = At(0.1 * i);
    row.is_guessed = (i >= 10 && i < 25) || (i >= 40 && i < 45);
    tally.AddRow(row);
  }
  EXPECT_NEAR(tally.Guessed_s(), 1.5, 1e-6);
}

TEST(RunTally, TellsHowLongASensorIsMissingAtTheEnd) {
  RunTally tally = Drive(0.0, 20.0);
  for (int i = 0; i <= 50; ++i) tally.AddImu(At(20.0 + 0.1 * i));
  EXPECT_NEAR(tally.WithoutSweeps_s(), 5.0, 1e-9);
  EXPECT_EQ(tally.WithoutImu_s(), 0.0);
  for (int i = 0; i <= 80; ++i) tally.AddSweep(At(20.0 + 0.1 * i));
  EXPECT_EQ(tally.WithoutSweeps_s(), 0.0);
  EXPECT_NEAR(tally.WithoutImu_s(), 3.0, 1e-9);
}

}  // namespace
}  // namespace lio
