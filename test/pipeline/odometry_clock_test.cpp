// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the estimator with lidar and IMU on clocks that differ.
#include <gtest/gtest.h>

#include <cmath>

#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Bytes;
using test::Message;
using test::Messages;
using test::RunOdometry;
using test::RunResult;
using test::StaticStartDrive;

TEST(Odometry, TheLidarsConfiguredOffsetIsTakenOffItsStamps) {
  constexpr double kConfigured_s = 0.3;
  Messages messages = StaticStartDrive();
  for (Message& message : messages) {
    if (!message.is_imu) {
      message.chunk.stamp = message.chunk.stamp - Duration::FromSeconds(kConfigured_s);
    }
  }
  Options options = test::DriveRig();
  options.rig.lidar.clock_offset_s = kConfigured_s;
  EXPECT_TRUE(Bytes(RunOdometry(messages, options).scans) ==
              Bytes(RunOdometry(StaticStartDrive(), test::DriveRig()).scans));
}

TEST(Odometry, TheClocksOffsetIsEstimatedUnlessSwitchedOff) {
  Options options = test::DriveRig();
  options.filter.estimate_clock_offset = false;
  const RunResult without = RunOdometry(StaticStartDrive(), options);
  options.filter.estimate_clock_offset = true;
  const RunResult with = RunOdometry(StaticStartDrive(), options);
  ASSERT_EQ(with.scans.size(), without.scans.size());
  EXPECT_EQ(without.scans.back().filter->clock_offset_std_s, 0.0);
  const FilterReport& last = *with.scans.back().filter;
  EXPECT_GT(last.clock_offset_std_s, 0.0);
  EXPECT_LT(std::abs(last.clock_offset_s), 4.0 * last.clock_offset_std_s) << "there is none";
}

}  // namespace
}  // namespace lio
