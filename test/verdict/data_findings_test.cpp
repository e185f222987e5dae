// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "verdict/data_findings.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace lio {
namespace {

const ImuRig kImu;

Counters CleanRun() {
  Counters counters;
  counters.num_imu = 1000;
  counters.num_chunks = 500;
  counters.num_scans = 100;
  return counters;
}

RunTally RunAt(double speed_mps, int num_rows = 100) {
  RunTally tally;
  for (int i = 0; i < 100; ++i) {
    PoseRow row;
    row.stamp = Timestamp{} + Duration::FromSeconds(0.1 * i);
    row.is_located = true;
    row.T_map_imu.translation.x() = 0.1 * speed_mps * i;
    for (int k = 0; k < 10; ++k) tally.AddImu(row.stamp + Duration::FromSeconds(0.01 * k));
    tally.AddSweep(row.stamp);
    if (i < num_rows) tally.AddRow(row);
  }
  return tally;
}

RunTally MovingRun() {
  return RunAt(5.0);
}

TEST(DataFindings, CleanRunHasNone) {
  EXPECT_TRUE(FindDataFaults(CleanRun(), MovingRun(), &kImu).empty());
}

TEST(DataFindings, EachFaultIsNamed) {
  struct Case {
    CauseKind kind;
    std::function<void(Counters&)> spoil;
  };
  const Case cases[] = {
      {CauseKind::kNoScans, [](Counters& counters) { counters.num_scans = 0; }},
      {CauseKind::kNoScans, [](Counters& counters) { counters.num_scans_empty = 100; }},
      {CauseKind::kNoImu, [](Counters& counters) { counters.num_imu = 0; }},
      {CauseKind::kTwoSenders, [](Counters& counters) { counters.num_imu_duplicate = 500; }},
      {CauseKind::kTwoSenders, [](Counters& counters) { counters.num_chunks_duplicate = 250; }},
      {CauseKind::kPointTime, [](Counters& counters) { counters.num_chunks_bad = 100; }},
      {CauseKind::kSaturation, [](Counters& counters) { counters.num_imu_clipped = 100; }},
      {CauseKind::kWayLost, [](Counters& counters) { counters.num_lost = 1; }},
  };
  for (const Case& spoiled : cases) {
    SCOPED_TRACE(std::string(Name(spoiled.kind)));
    Counters counters = CleanRun();
    spoiled.spoil(counters);
    const std::vector<Cause> causes = FindDataFaults(counters, MovingRun(), &kImu);
    ASSERT_EQ(causes.size(), 1U);
    EXPECT_EQ(causes[0].kind, spoiled.kind);
    EXPECT_NE(causes[0].leaves, Trust::kYes);
    EXPECT_FALSE(causes[0].evidence.empty());
  }
}

TEST(DataFindings, LidarAloneWantsNoImu) {
  Counters counters = CleanRun();
  counters.num_imu = 0;
  EXPECT_TRUE(FindDataFaults(counters, MovingRun(), nullptr).empty());
}

TEST(DataFindings, RestIsSaidButLeavesTrust) {
  const std::vector<Cause> causes = FindDataFaults(CleanRun(), RunAt(0.0), &kImu);
  ASSERT_EQ(causes.size(), 1U);
  EXPECT_EQ(causes[0].kind, CauseKind::kNoMotion);
  EXPECT_EQ(causes[0].leaves, Trust::kYes);
}

TEST(DataFindings, RestIsNotSaidOfABodyThatHadNoPosesMostOfTheTime) {
  EXPECT_TRUE(FindDataFaults(CleanRun(), RunAt(0.0, 20), &kImu).empty());
}

RunTally RunWithNoise(const ImuNoiseRatios& noise) {
  RunTally tally = MovingRun();
  for (int i = 100; i < 300; ++i) {
    PoseRow row;
    row.stamp = Timestamp{} + Duration::FromSeconds(0.1 * i);
    row.imu_noise = noise;
    tally.AddRow(row);
  }
  return tally;
}

TEST(DataFindings, SlowInertialSamplesAreNamedAndDoneWithout) {
  RunTally tally;
  for (int i = 0; i < 100; ++i) {
    tally.AddImu(Timestamp{} + Duration::FromSeconds(0.1 * i));
    tally.AddSweep(Timestamp{} + Duration::FromSeconds(0.1 * i));
  }
  const std::vector<Cause> causes = FindDataFaults(CleanRun(), tally, &kImu);
  ASSERT_EQ(causes.size(), 1U);
  EXPECT_EQ(causes[0].kind, CauseKind::kImuSlow);
  EXPECT_NE(causes[0].fix.find("use_imu: false"), std::string::npos);
}

// A body that stays blind for long may have stopped or driven on.
TEST(DataFindings, AWayThatWasGuessedForLongLeavesDoubt) {
  for (const int num_guessed : {15, 25}) {
    RunTally tally = MovingRun();
    for (int i = 100; i < 100 + num_guessed; ++i) {
      PoseRow row;
      row.stamp = Timestamp{} + Duration::FromSeconds(0.1 * i);
      row.is_guessed = true;
      tally.AddRow(row);
    }
    const std::vector<Cause> causes = FindDataFaults(CleanRun(), tally, nullptr);
    ASSERT_EQ(causes.size(), num_guessed > 20 ? 1U : 0U);
    if (causes.empty()) continue;
    EXPECT_EQ(causes[0].kind, CauseKind::kWayGuessed);
    EXPECT_EQ(causes[0].leaves, Trust::kDoubtful);
  }
}

TEST(DataFindings, NoiseFarAboveTheRigIsNamedWhereItIsTooMuchToBeOfUse) {
  ImuRig tactical;
  tactical.gyro_noise_density = 1e-5;
  tactical.accel_noise_density = 1e-4;
  const RunTally shaken = RunWithNoise({10.0, 400.0});
  EXPECT_TRUE(FindDataFaults(CleanRun(), shaken, &tactical).empty());
  const std::vector<Cause> accel = FindDataFaults(CleanRun(), shaken, &kImu);
  ASSERT_EQ(accel.size(), 1U);
  EXPECT_EQ(accel[0].kind, CauseKind::kImuNoise);
  const std::vector<Cause> gyro =
      FindDataFaults(CleanRun(), RunWithNoise({2000.0, 1.0}), &tactical);
  ASSERT_EQ(gyro.size(), 1U);
  EXPECT_EQ(gyro[0].kind, CauseKind::kImuNoise);
}

}  // namespace
}  // namespace lio
