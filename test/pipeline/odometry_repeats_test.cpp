// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the estimator as a whole where the lidar's driver sends the same sweep again and again.
#include <gtest/gtest.h>

#include <map>

#include "lio/pipeline/odometry.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Messages;
using test::RestThenDrive;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;

// The points of the sweep before that time come under the stamps of all that follow.
Messages Repeated(const test::Motion& motion, double from_s, double until_s) {
  test::DriveOptions options;
  options.motion = motion;
  options.to_s = 9.0;
  Messages messages = SimulateDrive(test::Street(), options);
  std::map<int, std::vector<LidarPoint>> last;  // by chunk
  for (test::Message& message : messages) {
    if (message.is_imu) continue;
    const double t_s = SecondsOf(message.chunk.stamp);
    std::vector<LidarPoint>& points = last[message.chunk.chunk_index];
    if (t_s >= from_s && t_s < until_s) {
      message.chunk.points = points;
    } else {
      points = message.chunk.points;
    }
  }
  return messages;
}

constexpr const char* kNotice = "the lidar sends the same points again";

TEST(OdometryRepeats, ScansThatRepeatThemselvesArePassedOverAndTheWayIsSaidToBeLost) {
  const RunResult run = RunOdometry(Repeated(RestThenDrive(), 5.0, 100.0), test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, kNotice));
  EXPECT_FALSE(test::HasNotice(run, "lidar-only"));
  EXPECT_GT(run.counters.num_scans_repeated, 30);
  EXPECT_EQ(run.counters.num_restarts, 0);
  EXPECT_EQ(run.status, TrackingStatus::kLost);
  for (const ScanOutput& output : run.scans) {
    const double t_s = SecondsOf(output.scan.stamp);
    if (t_s > 5.3) {
      EXPECT_FALSE(output.scan.fused) << t_s;
    }
    if (t_s > 7.5) {
      EXPECT_EQ(output.filter->nav.status, TrackingStatus::kLost) << t_s;
    }
  }
}

TEST(OdometryRepeats, TheWayGoesOnWhenTheLidarDoes) {
  const RunResult run = RunOdometry(Repeated(RestThenDrive(), 5.0, 6.0), test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, kNotice));
  EXPECT_EQ(run.status, TrackingStatus::kOk);
  EXPECT_LT(test::ErrorAgainst(RestThenDrive(), run.scans, 7.0).end_m, 0.2);
}

// A simulator without noise repeats its scans wherever it stands.
TEST(OdometryRepeats, ABodyThatStandsMaySeeTheSameAgain) {
  const auto stand = [](double) { return Pose{}; };
  const RunResult run = RunOdometry(Repeated(stand, 3.0, 100.0), test::DriveRig());
  EXPECT_FALSE(test::HasNotice(run, kNotice));
  EXPECT_EQ(run.counters.num_scans_repeated, 0);
  EXPECT_EQ(run.status, TrackingStatus::kOk);
}

}  // namespace
}  // namespace lio
