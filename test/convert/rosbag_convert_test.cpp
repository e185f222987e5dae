// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/rosbag_convert.hpp"

#include <gtest/gtest.h>

#include "convert/recorded_bag.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

using test::Driver;
using test::Drivers;
using test::kRecordingBegin;
using test::Recording;
using test::RosbagConversion;

class EveryDriver : public RosbagConversion, public testing::WithParamInterface<Driver> {};

TEST_P(EveryDriver, KeepsPointsTimesAndRingsOfRos1) {
  const Recording recording = WriteBag1(GetParam(), {.compression = "lz4"});
  const RosbagReport report = Convert();
  EXPECT_FALSE(report.IsDamaged());
  ExpectSame(recording, Log(), GetParam());
}

TEST_P(EveryDriver, KeepsPointsTimesAndRingsOfRos2) {
  const Recording recording = WriteBag2(GetParam(), true);
  const RosbagReport report = Convert();
  EXPECT_FALSE(report.IsDamaged());
  ExpectSame(recording, Log(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Layouts, EveryDriver, testing::ValuesIn(Drivers()),
                         [](const auto& test) { return test.param.name; });

TEST_F(RosbagConversion, KeepsTheImuAsItWasReceived) {
  WriteBag1(Drivers()[0]);
  const RosbagReport report = Convert();
  const auto log = Log();
  ASSERT_GT(log.imu.size(), 290u);
  for (std::size_t i = 0; i < log.imu.size(); ++i) {
    const auto& imu = log.imu[i];
    const Timestamp stamp = kRecordingBegin + Duration{static_cast<std::int64_t>(i) * 10'000'000};
    EXPECT_EQ(imu.event_utime, (stamp + Duration::FromSeconds(0.002)).Microseconds());
    EXPECT_EQ(imu.sample.stamp, stamp);
    EXPECT_EQ(imu.sample.w_imu_radps, Vector3(0.0, 0.0, 0.1));
    EXPECT_EQ(imu.sample.f_imu_mps2.z(), 9.8 + 0.001 * static_cast<double>(i));
  }
  EXPECT_NEAR(report.imu.rate_hz(), 100.0, 0.01);
}

TEST_F(RosbagConversion, SaysWhatItDetected) {
  WriteBag1(Drivers()[0]);
  const std::string text = FormatReport(Convert(), options_);
  EXPECT_NE(text.find("field 'time' in s from the stamp, sweeps of 100.9 ms"), std::string::npos)
      << text;
  EXPECT_NE(text.find("stamp        sweep start: clouds come"), std::string::npos) << text;
  EXPECT_NE(text.find("ring         from the ring field, counted from below"), std::string::npos);
  EXPECT_NE(text.find("/points: 30 sweeps at 9.889 Hz, 5760 points each"), std::string::npos)
      << text;
}

TEST_F(RosbagConversion, WritesWholeScansWhenAsked) {
  WriteBag1(Drivers()[0]);
  options_.whole_scans = true;
  Convert();
  const auto log = Log();
  ASSERT_EQ(log.sweeps.size(), 30u);
  for (const auto& sweep : log.sweeps) EXPECT_EQ(sweep.num_chunks, 1);
}

TEST_F(RosbagConversion, CutsChunksToOneDatagram) {
  WriteBag1(Drivers()[0]);
  Convert();
  EventLogReader reader(options_.output);
  LogEvent event;
  while (reader.Next(event)) EXPECT_LT(event.data.size(), 65'000u);
  for (const auto& sweep : Log().sweeps) EXPECT_EQ(sweep.num_chunks, 2);
}

TEST_F(RosbagConversion, StampsAtTheEndAreSeenWithoutPointTime) {
  Driver driver = Drivers()[5];
  driver.stamp_is_end = true;
  driver.time_tolerance_s = 3e-5;  // the end is that of the last column, not of the last point
  const Recording recording = WriteBag1(driver);
  const RosbagReport report = Convert();
  EXPECT_EQ(report.rules.spin_stamp.meaning, StampMeaning::kSweepEnd);
  const auto log = Log();
  for (std::size_t k = 0; k < log.sweeps.size(); ++k) {
    const Timestamp first{log.sweeps[k].points.front().instant_ns};
    EXPECT_NEAR(SecondsBetween(recording.starts[k], first), 0.0, 3e-4);  // a column is 0.28 ms
  }
}

TEST_F(RosbagConversion, TheStampCanBeOverridden) {
  const Recording recording = WriteBag1(Drivers()[0]);
  options_.point_time.stamp = StampMeaning::kSweepEnd;
  Convert();
  const Timestamp last{Log().sweeps[3].points.back().instant_ns};
  EXPECT_NEAR(SecondsBetween(recording.starts[3], last), 0.0, 1e-6);
}

TEST_F(RosbagConversion, StartAndDurationCount) {
  WriteBag1(Drivers()[0]);
  options_.start_s = 1.0;
  options_.duration_s = 1.0;
  Convert();
  const auto log = Log();
  EXPECT_NEAR(static_cast<double>(log.sweeps.size()), 10.0, 1.0);
  EXPECT_NEAR(static_cast<double>(log.imu.size()), 100.0, 1.0);
  options_.start_s = 1000.0;
  EXPECT_THROW((void)Convert(), InputError);
}

TEST_F(RosbagConversion, TruthGoesToTum) {
  WriteBag1(Drivers()[0]);
  options_.truth_file = dir_.path() / "truth.tum";
  const RosbagReport report = Convert();
  const Trajectory truth = ReadTrajectory(*options_.truth_file);
  ASSERT_EQ(static_cast<std::int64_t>(truth.poses.size()), report.truth->num_rows);
  EXPECT_EQ(truth.poses[1].stamp, kRecordingBegin + Duration{200'000'000});
  EXPECT_NEAR(truth.poses[1].pose.translation.x(), 2.0, 1e-9);
}

TEST_F(RosbagConversion, WithoutImuIsLidarOnly) {
  test::Bag1Writer writer(dir_.path() / "drive.bag");
  Record(
      Drivers()[0],
      [&](auto& topic, auto& type, Timestamp received, auto& data) {
        if (type == "PointCloud2") writer.Write(topic, "sensor_msgs/PointCloud2", received, data);
      },
      test::RosBytes());
  writer.Close();
  options_.input = dir_.path() / "drive.bag";
  const RosbagReport report = Convert();
  EXPECT_FALSE(report.topics.imu);
  EXPECT_TRUE(Log().imu.empty());
  EXPECT_NE(FormatReport(report, options_).find("lidar-only"), std::string::npos);
}

TEST_F(RosbagConversion, MemoryDoesNotGrowWithDisorder) {
  // A clock that jumps by an hour and back must not hold events back for ever.
  test::Bag1Writer writer(dir_.path() / "drive.bag");
  const test::SpinningLidar lidar;
  for (int k = 0; k < 40; ++k) {
    const Timestamp stamp = kRecordingBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
    const Duration jump = Duration::FromSeconds(k >= 20 && k < 25 ? 3600.0 : 0.0);
    writer.Write("/points", "sensor_msgs/PointCloud2", stamp + Duration::FromSeconds(0.105) + jump,
                 test::CloudMessage(test::VelodyneCloud(stamp, test::SeePoints(lidar, k))));
  }
  writer.Close();
  options_.input = dir_.path() / "drive.bag";
  options_.output = dir_.path() / "out.lcm";
  const RosbagReport report = ConvertRosbag(options_);
  EXPECT_EQ(report.lidar.num(), 40);
  EventLogReader reader(options_.output);
  LogEvent event;
  std::int64_t last = 0;
  while (reader.Next(event)) {
    EXPECT_GE(event.utime, last);
    last = event.utime;
  }
}

}  // namespace
}  // namespace lio
