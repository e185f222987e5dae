// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the estimator as a whole on drives with every kind of fault.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "lio/pipeline/odometry.hpp"
#include "lio/pipeline/registration_worker.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Bytes;
using test::ErrorAgainst;
using test::ExpectStampsIncrease;
using test::IsBetween;
using test::MakeBlind;
using test::Message;
using test::Messages;
using test::RestThenDrive;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;
using test::SortedByArrival;
using test::StaticStartDrive;
using test::Where;
using test::WithClockStep;

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

// Every third sample comes 30 ms late, but before the end of its sweep has been passed.
TEST(Odometry, OutOfOrderSamplesChangeNothing) {
  const Messages in_order = StaticStartDrive();
  Messages messages = in_order;
  constexpr double kSweep_s = 0.1;  // the drive's sweeps begin at multiples of it
  int count = 0;
  for (Message& message : messages) {
    if (!message.is_imu) continue;
    const double in_sweep_s = std::fmod(SecondsOf(message.sample.stamp) + 1e-9, kSweep_s);
    if (in_sweep_s < 0.06 && ++count % 3 == 0) {
      message.arrival = message.arrival + Duration::FromSeconds(0.03);
    }
  }
  ASSERT_GT(count, 200);
  const RunResult run = RunOdometry(SortedByArrival(messages), test::DriveRig());
  const RunResult expected = RunOdometry(in_order, test::DriveRig());
  EXPECT_EQ(run.counters.num_imu_duplicate, 0);
  EXPECT_EQ(run.counters.num_imu_late, 0);
  EXPECT_TRUE(Bytes(run.scans) == Bytes(expected.scans));
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

// Each sensor has its own clock, one of them since the machine started.
TEST(OdometryFaults, ClocksFarApartAreTold) {
  for (const double lidar_ahead_s : {37.0, -37.0}) {
    Messages messages = StaticStartDrive();
    for (Message& message : messages) {
      message.chunk.stamp = message.chunk.stamp + Duration::FromSeconds(lidar_ahead_s);
    }
    const RunResult run = RunOdometry(messages, test::DriveRig());
    EXPECT_TRUE(test::HasNotice(run, lidar_ahead_s > 0.0 ? "s after the inertial samples"
                                                         : "s before the inertial samples"));
    EXPECT_GT(run.counters.num_scans_without_imu, 0);
  }
}

}  // namespace
}  // namespace lio
