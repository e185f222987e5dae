// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests FormatReport on reports made by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lio/convert/rosbag_convert.hpp"

namespace lio {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Timestamp StampOfBag(double t_s) {
  return Timestamp{1'500'000'000'000'000'000} + Duration::FromSeconds(t_s);
}

RosbagOptions SomeOptions() {
  RosbagOptions options;
  options.input = "drive.bag";
  options.output = "drive.lcm";
  options.truth_file = "truth.tum";
  return options;
}

// Reports eleven sweeps of 100 points within a second, received 105 ms after their stamps, and no
// IMU.
RosbagReport LidarReport() {
  RosbagReport report;
  report.topics.lidar = "/points";
  report.all_topics.push_back({"/points", "sensor_msgs/PointCloud2", "", RosEncoding::kRos1, 11});
  for (int i = 0; i <= 10; ++i) report.lidar.Add(StampOfBag(0.1 * i), StampOfBag(0.1 * i + 0.105));
  report.num_points = 1100;
  report.rules.fields = "x(float32)";
  report.rules.point_time_text = "field 'time' in s";
  report.rules.stamp_text = "sweep start: because";
  report.rules.ring.description = "from the ring field";
  report.num_events = 11;
  return report;
}

void AddImu(RosbagReport& report) {
  report.topics.imu = "/imu";
  for (int i = 0; i <= 300; ++i) {
    ImuSample sample;
    sample.stamp = StampOfBag(0.01 * i);
    sample.f_imu_mps2 = {0, 0, 9.81};
    sample.w_imu_radps = {0, 0.25, 0};
    report.imu.Add(sample.stamp, sample.stamp + Duration{2'000'000});
    report.accelerometer.Add(sample);
  }
}

std::string Text(const RosbagReport& report) {
  return FormatReport(report, SomeOptions());
}

TEST(RosbagReport, SaysWhatWasReadAndWhatIsWritten) {
  const std::string text = Text(LidarReport());
  EXPECT_THAT(text, StartsWith("input        drive.bag\n"
                               "             /points (sensor_msgs/PointCloud2): 11 messages\n"
                               "lidar        /points: 11 sweeps at 10.000 Hz, 100 points each\n"));
  EXPECT_THAT(text, HasSubstr("stamps 1500000000.000000000 to 1500000001.000000000 (1.000 s)\n"));
  EXPECT_THAT(text, HasSubstr("received 105.0 ms after the stamp on average; longest period "
                              "100.0 ms, 0 gaps, 0 stamps not increasing\n"));
  EXPECT_THAT(text, HasSubstr("\npoint time   field 'time' in s\n"
                              "stamp        sweep start: because\n"
                              "ring         from the ring field\n"));
  EXPECT_THAT(text, EndsWith("output       drive.lcm: 11 events on LIO_SCAN and LIO_IMU\n"));
}

TEST(RosbagReport, ASoundRecordingHasNoLinesOfFaults) {
  RosbagReport report = LidarReport();
  AddImu(report);
  EXPECT_FALSE(report.IsDamaged());
  const std::string text = Text(report);
  for (const char* word : {"left out", "damaged", "note", "intensity ", "not finite", "truth"}) {
    EXPECT_THAT(text, Not(HasSubstr(word)));
  }
}

TEST(RosbagReport, TellsWhatTheImuMeasures) {
  RosbagReport report = LidarReport();
  AddImu(report);
  EXPECT_THAT(Text(report), AllOf(HasSubstr("imu          /imu: 301 samples at 100.00 Hz\n"),
                                  HasSubstr("received 2.0 ms after the stamp"),
                                  HasSubstr("mean |accel| 9.810, in the quietest second 9.810: "),
                                  HasSubstr("largest |gyro| 0.25 rad/s\n")));
}

TEST(RosbagReport, RatesInDegreesAreSuspected) {
  RosbagReport report = LidarReport();
  AddImu(report);
  ImuSample fast;
  fast.stamp = StampOfBag(10);
  fast.w_imu_radps = {40, 0, 0};
  report.accelerometer.Add(fast);
  EXPECT_THAT(Text(report), HasSubstr("largest |gyro| 40.00 rad/s: looks like degrees a second"));
}

TEST(RosbagReport, AMissingOrSilentImuIsTold) {
  RosbagReport report = LidarReport();
  EXPECT_THAT(Text(report), HasSubstr("imu          none: the log serves lidar-only odometry\n"));
  report.topics.imu = "/imu";
  EXPECT_THAT(Text(report), HasSubstr("imu          /imu: 0 samples at 0.00 Hz\n"));
}

TEST(RosbagReport, WhatWasLeftOutIsCounted) {
  RosbagReport report = LidarReport();
  report.num_points_nonfinite = 12;
  report.num_points_zero = 34;
  report.num_empty = 5;
  report.rules.intensity_scale = 255.0f;
  EXPECT_THAT(Text(report),
              AllOf(HasSubstr("left out: 12 points not finite, 34 without return, 5 clouds "
                              "without points\n"),
                    HasSubstr("intensity    0..1 in the source, times 255\n")));
}

TEST(RosbagReport, TruthIsToldWithItsFrameAndDelay) {
  RosbagReport report = LidarReport();
  report.topics.truth = "/ins";
  report.truth_description = "poses of the INS";
  report.truth.emplace();
  report.truth->num_rows = 4;
  report.truth->first = StampOfBag(0);
  report.truth->last = StampOfBag(3);
  report.truth->delay_sum_s = 0.04;
  EXPECT_THAT(Text(report),
              AllOf(HasSubstr("truth        /ins: 4 rows to truth.tum\n"),
                    HasSubstr("             poses of the INS\n"),
                    HasSubstr("received 10.0 ms later on average"), Not(HasSubstr("left out"))));
  report.truth->num_not_good = 7;
  report.truth->num_damaged = 1;
  EXPECT_THAT(Text(report), HasSubstr("left out: 7 rows whose INS status is not good, 1 damaged, "
                                      "0 not increasing\n"));
}

TEST(RosbagReport, DamageIsNamedWithItsPlace) {
  RosbagReport report = LidarReport();
  report.num_damaged["/points: too short"] = 3;
  EXPECT_TRUE(report.IsDamaged());
  EXPECT_THAT(Text(report), HasSubstr("damaged      3 messages skipped, /points: too short\n"));
  report.damage.not_closed = true;
  EXPECT_THAT(Text(report),
              AllOf(HasSubstr("the bag was never closed, it has no index: 0 bytes lost"),
                    HasSubstr("converted up to 1500000001.000000000\n")));
  report.damage.cut_short = true;
  report.damage.lost_bytes = 4711;
  report.damage.num_messages_missing = 6;
  report.damage.first_reason = "record header of 9 bytes";
  EXPECT_THAT(Text(report),
              AllOf(HasSubstr("the bag is cut short: 4711 bytes lost, 0 broken chunks, 0 broken "
                              "records, 6 messages missing\n"),
                    HasSubstr("first: record header of 9 bytes\n")));
}

TEST(RosbagReport, NotesAndLateEventsAreTold) {
  RosbagReport report = LidarReport();
  report.notes = {"mind the gap"};
  report.num_late_events = 2;
  EXPECT_THAT(Text(report), AllOf(HasSubstr("note         mind the gap\n"),
                                  HasSubstr("note         2 events were received over ")));
}

}  // namespace
}  // namespace lio
