// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/imu_file.hpp"

#include <gmock/gmock.h>

#include "lio/io/event_log.hpp"
#include "lio/io/input_error.hpp"
#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

constexpr Timestamp kFirstStamp{1'700'000'000'250'000'000};
const ImuSample kSample{kFirstStamp, {0.1, -0.2, 0.3}, {1.0, 2.0, 9.8}};

void ExpectSample(const ImuFile& imu) {
  ASSERT_EQ(imu.samples.size(), 1u);
  EXPECT_EQ(imu.samples[0].sample.stamp, kFirstStamp);
  EXPECT_EQ(imu.samples[0].sample.w_imu_radps, kSample.w_imu_radps);
  EXPECT_EQ(imu.samples[0].sample.f_imu_mps2, kSample.f_imu_mps2);
}

TEST(ImuFile, ATableHasSecondsOrNanosecondsAndPerhapsAHeading) {
  const test::TempDir dir;
  for (const char* text : {"1700000000250000000,0.1,-0.2,0.3,1.0,2.0,9.8\n",
                           "#timestamp [ns],w,w,w,a,a,a\r\n"
                           "1700000000250000000,0.1,-0.2,0.3,1.0,2.0,9.8\r\n",
                           "t,wx,wy,wz,ax,ay,az\n1700000000.25 0.1 -0.2 0.3 1.0 2.0 9.8\n"}) {
    const ImuFile imu = ReadImuFile(dir.Write("imu.csv", text));
    ExpectSample(imu);
    EXPECT_EQ(imu.num_damaged, 0) << text;
  }
}

TEST(ImuFile, LinesThatAreNoSamplesAreCounted) {
  const test::TempDir dir;
  const ImuFile imu = ReadImuFile(
      dir.Write("imu.csv",
                "1700000000.25,0.1,-0.2,0.3,1.0,2.0,9.8\n1700000000.26,0.1\n1,2,3,x,5,6,7\n\n"
                "9223372036854775807,0.1,-0.2,0.3,1.0,2.0,9.8\n"));
  ExpectSample(imu);
  EXPECT_EQ(imu.num_damaged, 3);
}

TEST(ImuFile, ALogAndABagAreReadToo) {
  const test::TempDir dir;
  {
    EventLogWriter log(dir.path() / "imu.lcm");
    log.Write(kFirstStamp.Microseconds(), "LIO_IMU", EncodeImu(kSample, 0));
    log.Write(kFirstStamp.Microseconds(), "LIO_IMU", {});
    log.Close();
    test::Bag1Writer bag(dir.path() / "imu.bag");
    bag.Write("/imu", "sensor_msgs/Imu", kFirstStamp, test::ImuMessage(kSample));
    bag.Close();
  }
  const ImuFile of_log = ReadImuFile(dir.path() / "imu.lcm");
  ExpectSample(of_log);
  EXPECT_EQ(of_log.num_damaged, 1);
  const ImuFile of_bag = ReadImuFile(dir.path() / "imu.bag");
  ExpectSample(of_bag);
  EXPECT_THAT(of_bag.description, testing::HasSubstr("/imu"));
}

TEST(ImuFile, WhatHasNoSampleIsRefused) {
  const test::TempDir dir;
  EXPECT_THROW((void)ReadImuFile(dir.Write("imu.csv", "")), InputError);
  EXPECT_THROW((void)ReadImuFile(dir.Write("imu.csv", "some\nother\ntext\n")), InputError);
  EXPECT_THROW((void)ReadImuFile("/no/such.csv"), InputError);
  test::Bag1Writer bag(dir.path() / "two.bag");
  bag.Write("/left", "sensor_msgs/Imu", kFirstStamp, test::ImuMessage(kSample));
  bag.Write("/right", "sensor_msgs/Imu", kFirstStamp, test::ImuMessage(kSample));
  bag.Close();
  EXPECT_THROW((void)ReadImuFile(dir.path() / "two.bag"), UsageError);
}

}  // namespace
}  // namespace lio
