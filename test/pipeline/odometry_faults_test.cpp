// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimator as a whole on drives with every kind of fault.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "lio/pipeline/match_side.hpp"
#include "lio/pipeline/odometry.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Bytes;
using test::ErrorAgainst;
using test::ExpectStampsIncrease;
using test::IsBetween;
using test::kEnd_s;
using test::LidarOnly;
using test::MakeBlind;
using test::Message;
using test::Messages;
using test::NumFused;
using test::RestThenDrive;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;
using test::SortedByArrival;
using test::StaticStartDrive;
using test::Where;
using test::WithClockStep;
using test::WithoutImu;
using test::WithoutLidar;

// --- faults of messages

TEST(Odometry, DuplicatesChangeNothing) {
  Messages doubled;
  for (const Message& message : StaticStartDrive()) {
    doubled.push_back(message);
    doubled.push_back(message);
  }
  const RunResult run = RunOdometry(doubled, test::DriveRig());
  const RunResult plain = RunOdometry(StaticStartDrive(), test::DriveRig());
  EXPECT_TRUE(Bytes(run.scans) == Bytes(plain.scans));
  EXPECT_EQ(run.counters.num_imu_duplicate + run.counters.num_imu_late, plain.counters.num_imu);
  EXPECT_EQ(run.counters.num_chunks_duplicate + run.counters.num_chunks_late,
            plain.counters.num_chunks);
}

TEST(Odometry, OutOfOrderSamplesChangeNothing) {
  Messages messages = StaticStartDrive();
  // Every third sample comes 30 ms late: before any sweep that needs it is closed by others.
  int count = 0;
  for (Message& message : messages) {
    if (message.is_imu && ++count % 3 == 0) {
      message.arrival = message.arrival + Duration::FromSeconds(0.03);
    }
  }
  const RunResult run = RunOdometry(SortedByArrival(messages), test::DriveRig());
  EXPECT_EQ(run.counters.num_imu_duplicate, 0);
  EXPECT_LT(run.counters.num_imu_late, 200);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
  ExpectStampsIncrease(run);
}

TEST(Odometry, LateSamplesAreCountedAndLeftOut) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (message.is_imu && IsBetween(message, 3.0, 3.02)) {
      message.arrival = message.arrival + Duration::FromSeconds(0.7);
    }
  }
  const RunResult run = RunOdometry(SortedByArrival(messages), test::DriveRig());
  EXPECT_EQ(run.counters.num_imu_late, 2);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
}

TEST(Odometry, NonFiniteSamplesAreLeftOut) {
  Messages messages = StaticStartDrive();
  int num_bad = 0;
  for (std::size_t i = 0; i < messages.size(); i += 17) {
    if (!messages[i].is_imu) continue;
    messages[i].sample.f_imu_mps2.y() = std::numeric_limits<double>::quiet_NaN();
    ++num_bad;
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_imu_nonfinite, num_bad);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
}

TEST(Odometry, NonFinitePointsAreLeftOut) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    for (std::size_t i = 0; i < message.chunk.points.size(); i += 3) {
      message.chunk.points[i].x_m = std::numeric_limits<float>::quiet_NaN();
    }
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_GT(run.counters.num_points_nonfinite, 10000);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
}

// A second without one return while driving: the IMU carries on, and the map it comes back to is
// the old one, not a new one begun where the filter then believed itself.
TEST(Odometry, BlindSweepsAreCarriedByTheImu) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (IsBetween(message, 4.0, 5.0)) MakeBlind(message);
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_GE(run.counters.num_matches_rejected, 9);
  EXPECT_EQ(run.counters.num_gated, 0);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.15);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 0.06);
  EXPECT_TRUE(run.scans.back().scan.fused);
  ExpectStampsIncrease(run);
}

TEST(Odometry, BlindSweepsWidenTheCovarianceUntilTheLidarSeesAgain) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (IsBetween(message, 4.0, 5.0)) MakeBlind(message);
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  double before = 0, blind = 0, after = 0;  // variance of the pose in the map
  for (const ScanOutput& output : run.scans) {
    const double t_s = SecondsOf(output.scan.stamp);
    const double variance = output.filter->nav.map_pose_cov.topLeftCorner<3, 3>().trace();
    if (t_s < 4.0) before = variance;
    if (t_s < 5.0) blind = variance;
    after = variance;
  }
  EXPECT_GT(blind, 4 * before);
  EXPECT_LT(after, 0.5 * blind);
}

TEST(Odometry, EmptySweepsAreCountedAndSurvived) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (!message.is_imu && (message.chunk.scan_seq == 3 || message.chunk.scan_seq == 40)) {
      message.chunk.points.clear();
    }
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_scans_empty, 2);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
  ExpectStampsIncrease(run);
}

TEST(Odometry, MissingChunksMakeSmallerScans) {
  const Messages messages = Where(StaticStartDrive(), [](const Message& message) {
    const ScanChunk& chunk = message.chunk;
    return message.is_imu || chunk.scan_seq % 4 != 1 || chunk.chunk_index != chunk.scan_seq % 3;
  });
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_chunks_missing, 16);
  EXPECT_EQ(run.counters.num_scans, 65);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
  ExpectStampsIncrease(run);
}

TEST(Odometry, BadChunksAreCountedAndLeftOut) {
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (message.is_imu || message.chunk.scan_seq % 10 != 5) continue;
    if (message.chunk.chunk_index == 1) message.chunk.chunk_index = 77;
    if (message.chunk.chunk_index == 2) message.chunk.points[0].t_offset_ns = 4'000'000'000u;
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(run.counters.num_chunks_bad, 12);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.08);
}

// --- faults of streams

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
  EXPECT_GT(run.counters.num_scans_without_imu, 5);
  EXPECT_EQ(run.scans.back().scan.scan_seq, 64);
  EXPECT_TRUE(run.scans.back().scan.fused);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.3);
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

TEST(Odometry, OneWildStampOfEitherSensorIsSurvived) {
  for (const double shift_s : {3600.0, -3600.0, 0.8, -0.8}) {
    for (const bool of_imu : {true, false}) {
      Messages messages = StaticStartDrive();
      for (Message& message : messages) {
        if (message.is_imu != of_imu || !IsBetween(message, 4.0, 4.01 + (of_imu ? 0.0 : 0.09))) {
          continue;
        }
        const Duration shift = Duration::FromSeconds(shift_s);
        message.sample.stamp = message.sample.stamp + shift;
        message.chunk.stamp = message.chunk.stamp + shift;
      }
      const RunResult run = RunOdometry(messages, test::DriveRig());
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

TEST(Odometry, PublishedStampsNeverGoBack) {
  const Messages& drive = StaticStartDrive();
  Messages late = drive;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> delay_s(0.0, 0.2);
  for (Message& message : late) {
    message.arrival = message.arrival + Duration::FromSeconds(delay_s(random));
  }
  ExpectStampsIncrease(RunOdometry(SortedByArrival(late), test::DriveRig()));
  ExpectStampsIncrease(RunOdometry(SortedByArrival(late), test::DriveRig(), 20));
  ExpectStampsIncrease(RunOdometry(drive, test::DriveRig(), 20));
  ExpectStampsIncrease(RunOdometry(WithClockStep(drive, 3.5, 10.0), test::DriveRig()));
}

}  // namespace
}  // namespace lio
