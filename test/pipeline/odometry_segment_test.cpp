// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the estimator across gaps of its streams and steps of their clocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lio/pipeline/odometry.hpp"
#include "lio/pipeline/registration_worker.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Bytes;
using test::ErrorAgainst;
using test::ExpectStampsIncrease;
using test::IsBetween;
using test::kEnd_s;
using test::LidarOnly;
using test::Message;
using test::Messages;
using test::NumFused;
using test::RestThenDrive;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;
using test::StaticStartDrive;
using test::WithClockStep;
using test::WithoutImu;
using test::WithoutLidar;

TEST(Odometry, GapOfTheImuIsBridged) {
  const RunResult run = RunOdometry(WithoutImu(StaticStartDrive(), 4.0, 4.6), test::DriveRig());
  EXPECT_EQ(run.counters.num_imu_gaps, 1);
  EXPECT_EQ(run.counters.num_restarts, 0);
  const auto first = static_cast<std::size_t>(run.scans.front().scan.scan_seq);
  EXPECT_EQ(run.scans.size() + first, 65u) << "no scan is lost";
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.15);
  EXPECT_TRUE(run.scans.back().scan.fused);
  ExpectStampsIncrease(run);
}

TEST(Odometry, GapOfTheLidarIsBridged) {
  const RunResult run = RunOdometry(WithoutLidar(StaticStartDrive(), 4.0, 4.6), test::DriveRig());
  EXPECT_EQ(run.counters.num_scan_gaps, 1);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.1);
  EXPECT_TRUE(run.scans.back().scan.fused);
}

TEST(Odometry, GapOfTheLidarAloneIsBridged) {
  const RunResult run = RunOdometry(WithoutLidar(StaticStartDrive(), 4.0, 4.6), LidarOnly());
  EXPECT_EQ(run.counters.num_scan_gaps, 1);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.3);
  EXPECT_TRUE(run.scans.back().scan.fused);
}

TEST(Odometry, LongGapOfTheImuKeepsTheMap) {
  const RunResult run = RunOdometry(WithoutImu(StaticStartDrive(), 3.5, 5.0), test::DriveRig());
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 0.15);
  EXPECT_TRUE(run.scans.back().scan.fused);
  ExpectStampsIncrease(run);
}

TEST(Odometry, ImuDyingForGoodLeavesTheLidarTracking) {
  const RunResult run = RunOdometry(WithoutImu(StaticStartDrive(), 3.5, 100.0), test::DriveRig());
  EXPECT_EQ(run.counters.num_scans_without_imu, 0);
  EXPECT_EQ(run.counters.num_restarts, 1);
  EXPECT_EQ(run.scans.back().scan.scan_seq, 64);
  EXPECT_TRUE(run.scans.back().scan.fused);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.3);
  ExpectStampsIncrease(run);
}

TEST(Odometry, ImuThatComesAgainIsUsedAgain) {
  const RunResult run = RunOdometry(WithoutImu(StaticStartDrive(), 3.0, 4.5), test::DriveRig());
  EXPECT_EQ(run.counters.num_restarts, 1);
  EXPECT_NEAR(SecondsOf(run.navs.back().stamp), kEnd_s, 0.02) << "published at the IMU's rate";
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.3);
  EXPECT_NE(run.scans.back().filter->g_world_mps2.z(), 0.0);
  ExpectStampsIncrease(run);
}

TEST(Odometry, LidarDyingForGoodLeavesTheImuPublishing) {
  const RunResult run = RunOdometry(WithoutLidar(StaticStartDrive(), 4.0, 100.0), test::DriveRig());
  EXPECT_NEAR(SecondsOf(run.navs.back().stamp), kEnd_s, 1e-6);
  ExpectStampsIncrease(run);
}

TEST(Odometry, BothClocksSteppedTogetherGoOnWithTheMap) {
  for (const double shift_s : {100.0, -100.0}) {
    const Messages messages = WithClockStep(StaticStartDrive(), 3.5, shift_s);
    const RunResult run = RunOdometry(messages, test::DriveRig());
    EXPECT_EQ(run.counters.num_restarts, 1) << shift_s;
    // Scans before the step, and those after it in the time they were sent.
    std::vector<ScanOutput> after;
    for (const ScanOutput& output : run.scans) {
      if (std::abs(SecondsOf(output.scan.stamp) - shift_s) < 20.0) after.push_back(output);
    }
    EXPECT_GT(after.size(), 20u) << shift_s;
    EXPECT_TRUE(after.back().scan.fused) << shift_s;
    EXPECT_LT(ErrorAgainst(RestThenDrive(), after, 4.0, shift_s).max_m, 0.15) << shift_s;
  }
}

TEST(Odometry, ClocksSteppedForthAndBackGoOn) {
  Messages messages = WithClockStep(StaticStartDrive(), 3.0, 50.0);
  messages = WithClockStep(messages, 4.5, -50.0);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_restarts, 2);
  EXPECT_TRUE(run.scans.back().scan.fused);
  EXPECT_NEAR(SecondsOf(run.scans.back().scan.stamp), kEnd_s, 0.01);
}

// In the middle of sweeps, whose halves must not wait for a time that does not come. The step forth
// is taken for a gap, over which the state coasts by ten metres that are found to be none.
TEST(Odometry, ClocksSteppedBackForASecondGoOn) {
  Messages messages = WithClockStep(StaticStartDrive(), 3.54, -2.0);
  messages = WithClockStep(messages, 4.54, 2.0);
  for (const bool use_imu : {true, false}) {
    const RunResult run = RunOdometry(messages, use_imu ? test::DriveRig() : LidarOnly());
    std::vector<ScanOutput> after;
    for (const ScanOutput& output : run.scans) {
      if (SecondsOf(output.scan.stamp) > 4.7) after.push_back(output);
    }
    ASSERT_GT(after.size(), 5u);
    EXPECT_TRUE(std::all_of(after.begin(), after.end(), [](const auto& s) { return s.scan.fused; }))
        << use_imu;
    EXPECT_LT(ErrorAgainst(RestThenDrive(), after, 4.7).max_m, 0.25) << use_imu;
  }
}

// Shifts the stamps of one IMU sample or of one sweep.
Messages WithWildStamp(Messages messages, bool of_imu, double shift_s) {
  for (Message& message : messages) {
    if (message.is_imu != of_imu || !IsBetween(message, 4.0, of_imu ? 4.01 : 4.1)) continue;
    const Duration shift = Duration::FromSeconds(shift_s);
    message.sample.stamp = message.sample.stamp + shift;
    message.chunk.stamp = message.chunk.stamp + shift;
  }
  return messages;
}

TEST(Odometry, OneWildStampOfEitherSensorIsSurvived) {
  for (const double shift_s : {3600.0, -3600.0, 0.8, -0.8}) {
    for (const bool of_imu : {true, false}) {
      const RunResult run =
          RunOdometry(WithWildStamp(StaticStartDrive(), of_imu, shift_s), test::DriveRig());
      const std::string what = (of_imu ? "IMU by " : "lidar by ") + std::to_string(shift_s);
      EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans, -1e9).end_m, 0.1) << what;
      EXPECT_TRUE(run.scans.back().scan.fused) << what;
      EXPECT_EQ(run.scans.back().scan.scan_seq, 64) << what;
    }
  }
}

TEST(Odometry, WildStampsOfTheLidarAloneAreSurvived) {
  for (const double shift_s : {1e6, 30.0, -30.0}) {
    Messages messages = StaticStartDrive();
    for (Message& message : messages) {
      if (message.is_imu || message.chunk.scan_seq != 40) continue;
      message.chunk.stamp = message.chunk.stamp + Duration::FromSeconds(shift_s);
    }
    const RunResult run = RunOdometry(messages, LidarOnly());
    EXPECT_TRUE(run.scans.back().scan.fused) << shift_s;
    EXPECT_GT(NumFused(run), 50) << shift_s;
  }
}

TEST(Odometry, ClockOfTheLidarAloneSetBackGoesOn) {
  for (const double shift_s : {-100.0, 100.0}) {
    const Messages messages = WithClockStep(StaticStartDrive(), 3.5, shift_s);
    const RunResult run = RunOdometry(messages, LidarOnly());
    EXPECT_TRUE(run.scans.back().scan.fused) << shift_s;
    EXPECT_GT(NumFused(run), 50) << shift_s;
  }
}

TEST(Odometry, InertialClockThatStepsAloneIsPutRight) {
  for (const double shift_s : {-100.0, -1.3, -0.4, 0.3, 1.3}) {
    const Messages messages = WithClockStep(StaticStartDrive(), 3.5, shift_s, true, false);
    for (const Messages& sent : {messages, WithClockStep(messages, 5.0, -shift_s, true, false)}) {
      const RunResult run = RunOdometry(sent, test::DriveRig());
      EXPECT_EQ(run.counters.num_restarts, 0) << shift_s;
      EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.05) << shift_s;
      EXPECT_EQ(run.scans.back().scan.scan_seq, 64) << shift_s;
    }
  }
}

// Some IMUs have a clock that counts from their start, and may restart.
TEST(Odometry, InertialClockThatStepsAfterAnOutageIsPutRight) {
  const Messages messages = WithoutImu(StaticStartDrive(), 3.5, 4.0);
  for (const double shift_s : {-100.0, -0.9, 100.0}) {
    const RunResult run =
        RunOdometry(WithClockStep(messages, 4.0, shift_s, true, false), test::DriveRig());
    EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 0.1) << shift_s;
    EXPECT_EQ(run.counters.num_restarts, 0) << shift_s;
    EXPECT_TRUE(run.scans.back().scan.fused) << shift_s;
  }
}

// Gaps as long as the step, while sweeps come, are gaps.
TEST(Odometry, GapsNextToStepsAreNotTakenForThem) {
  const Messages gap_first =
      WithClockStep(WithoutImu(StaticStartDrive(), 2.5, 2.9), 4.0, -0.4, true, false);
  const Messages step_first =
      WithClockStep(WithoutImu(StaticStartDrive(), 4.5, 4.9), 3.0, -0.4, true, false);
  for (const Messages& messages : {gap_first, step_first}) {
    const RunResult run = RunOdometry(messages, test::DriveRig());
    EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 0.1);
    EXPECT_TRUE(run.scans.back().scan.fused);
  }
}

TEST(Odometry, StepsOneAfterTheOtherAreJudgedAlikeWheneverJobsAreFinished) {
  Messages messages = WithClockStep(StaticStartDrive(), 3.0, -5.0);
  messages = WithClockStep(messages, 3.2, -0.6, true, false);
  messages = WithClockStep(messages, 4.5, 5.0);
  const RunResult at_once = RunOdometry(messages, test::DriveRig());
  for (const int delay : {1, 5, 11, 20}) {
    const RunResult late = RunOdometry(messages, test::DriveRig(), delay);
    EXPECT_TRUE(Bytes(at_once.scans) == Bytes(late.scans)) << delay;
  }
  EXPECT_TRUE(at_once.scans.back().scan.fused);
}

TEST(Odometry, BothClocksSteppedBackByLessThanASecondGoOn) {
  for (const double shift_s : {-0.8, -0.3}) {
    const Messages messages = WithClockStep(StaticStartDrive(), 3.5, shift_s);
    const RunResult run = RunOdometry(messages, test::DriveRig());
    std::vector<ScanOutput> after;
    for (const ScanOutput& output : run.scans) {
      if (SecondsOf(output.scan.stamp) > 3.7) after.push_back(output);
    }
    EXPECT_TRUE(after.back().scan.fused) << shift_s;
    EXPECT_LT(ErrorAgainst(RestThenDrive(), after, 3.7, shift_s).max_m, 0.15) << shift_s;
  }
}

}  // namespace
}  // namespace lio
