// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests ProbeClouds, which finds the rules for reading a recording from its first clouds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "convert/recorded_bag.hpp"
#include "lio/convert/rosbag_convert.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

using test::kRecordingBegin;
using test::TestCloud;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class RosbagProbe : public test::RosbagConversion {
 protected:
  CloudRules Probe() { return ProbeClouds({"/points", "/imu", std::nullopt}, options_); }
  std::string FaultOfProbe() {
    try {
      Probe();
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing thrown";
  }
  // Writes a bag of 30 sweeps in Velodyne's layout, each passed through `change`.
  void WriteClouds(const std::function<void(TestCloud&)>& change) {
    options_.input = dir_.path() / "clouds.bag";
    test::Bag1Writer writer(options_.input);
    const test::SpinningLidar lidar;
    for (int k = 0; k < 30; ++k) {
      const Timestamp start = kRecordingBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
      TestCloud cloud = test::VelodyneCloud(start, test::SeePoints(lidar, k));
      change(cloud);
      writer.Write("/points", "sensor_msgs/PointCloud2", start + Duration{106'000'000},
                   test::CloudMessage(cloud));
    }
    writer.Close();
  }
};

const test::Driver& DriverOf(const std::string& name) {
  static const std::vector<test::Driver> kDrivers = test::Drivers();
  for (const test::Driver& driver : kDrivers) {
    if (driver.name == name) return driver;
  }
  throw std::invalid_argument(name);
}

TEST_F(RosbagProbe, UnitsAreToldByTheLengthOfASweep) {
  const std::vector<std::pair<std::string, TimeUnit>> cases = {
      {"VelodyneSeconds", TimeUnit::kSeconds},
      {"VelodyneMicrosecondsFloat", TimeUnit::kMicroseconds},
      {"Ouster", TimeUnit::kNanoseconds},
      {"Hesai", TimeUnit::kSeconds}};
  for (const auto& [name, unit] : cases) {
    WriteBag1(DriverOf(name));
    const CloudRules rules = Probe();
    ASSERT_TRUE(rules.point_time) << name;
    EXPECT_EQ(rules.point_time->unit, unit) << name;
    EXPECT_NEAR(rules.point_time->sweep_s, 0.1009, 1e-3) << name;
    EXPECT_EQ(rules.point_time->counts_from_epoch, name == "Hesai") << name;
    EXPECT_EQ(rules.point_time->stamp, StampMeaning::kSweepStart) << name;
  }
}

TEST_F(RosbagProbe, WhatWasDecidedIsSaidInWords) {
  WriteBag1(DriverOf("Hesai"));
  const CloudRules rules = Probe();
  EXPECT_EQ(rules.point_time_text, "field 'timestamp' in s since an epoch, sweeps of 100.9 ms");
  EXPECT_THAT(rules.stamp_text, StartsWith("sweep start: "));
  EXPECT_EQ(rules.fields, "x y z intensity(float32) timestamp(float64) ring(uint16)");
  EXPECT_EQ(rules.ring.description,
            "from the ring field, counted from above and therefore reversed");
}

TEST_F(RosbagProbe, WithoutTimesTheSpinIsMeasured) {
  for (const std::string name : {"VelodyneWithoutTime", "VelodyneWithZeroTimes"}) {
    WriteBag1(DriverOf(name));
    const CloudRules rules = Probe();
    EXPECT_FALSE(rules.point_time) << name;
    EXPECT_EQ(rules.spin.direction, -1.0) << name;
    EXPECT_NEAR(rules.spin.rate_radps, 2.0 * M_PI / 0.1, 0.1) << name;
    const bool has_field = name == "VelodyneWithZeroTimes";
    EXPECT_THAT(rules.point_time_text,
                HasSubstr(has_field ? "because field 'time' is constant" : "have no time field"));
  }
}

TEST_F(RosbagProbe, TheUsersWordOnTheStampCounts) {
  WriteBag1(DriverOf("VelodyneWithoutTime"));
  options_.point_time.stamp = StampMeaning::kSweepEnd;
  const CloudRules rules = Probe();
  EXPECT_EQ(rules.spin_stamp.meaning, StampMeaning::kSweepEnd);
  EXPECT_EQ(rules.stamp_text, "sweep end: given by --stamp");
}

TEST_F(RosbagProbe, OnlyIntensitiesOfZeroToOneAreScaled) {
  const std::vector<std::pair<double, float>> cases = {
      {0.5, 255.0f}, {1.0, 255.0f}, {1.5, 1.0f}, {200.0, 1.0f}, {0.0, 1.0f}};
  for (const auto& [largest, scale] : cases) {
    WriteClouds([&, largest = largest](TestCloud& cloud) {
      for (std::size_t i = 0; i < cloud.width; ++i) cloud.Set(i, "intensity", 0.0);
      cloud.Set(3, "intensity", largest);
    });
    EXPECT_EQ(Probe().intensity_scale, scale) << largest;
  }
}

TEST_F(RosbagProbe, AModelGivesRingsWhereTheSourceHasNone) {
  WriteBag1(DriverOf("RoboSenseBare"));
  EXPECT_EQ(Probe().ring.source, RingRule::Source::kNone);
  options_.lidar_model = "vlp16";
  const CloudRules rules = Probe();
  EXPECT_EQ(rules.ring.source, RingRule::Source::kModel);
  EXPECT_EQ(rules.ring.table.num_beams(), 16);
  options_.lidar_model = "vlp99";
  EXPECT_THROW(Probe(), UsageError);
}

TEST_F(RosbagProbe, CloudsWithoutPlacesAreRefusedByTheirFields) {
  WriteClouds([](TestCloud& cloud) { cloud.fields.erase(cloud.fields.begin()); });
  EXPECT_THAT(FaultOfProbe(), AllOf(StartsWith("/points: its clouds have no fields x, y and z"),
                                    HasSubstr("but y z intensity(float32)")));
}

TEST_F(RosbagProbe, DamagedCloudsAreCountedInTheRefusal) {
  options_.input = dir_.path() / "broken.bag";
  test::Bag1Writer writer(options_.input);
  for (int i = 0; i < 4; ++i) {
    writer.Write("/points", "sensor_msgs/PointCloud2", kRecordingBegin + Duration{i},
                 std::vector<std::uint8_t>(10));
  }
  writer.Close();
  EXPECT_EQ(FaultOfProbe(), "/points: no cloud with returns can be read (4 damaged)");
}

TEST_F(RosbagProbe, TheFirstCloudsMayBeEmptyOrDamaged) {
  int k = 0;
  WriteClouds([&](TestCloud& cloud) {
    if (++k <= 3) cloud = test::VelodyneCloud(cloud.stamp, {});
  });
  const CloudRules rules = Probe();
  ASSERT_TRUE(rules.point_time);
  EXPECT_EQ(rules.point_time->unit, TimeUnit::kSeconds);
}

}  // namespace
}  // namespace lio
