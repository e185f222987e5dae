// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/cloud_to_sweep.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "support/spinning_lidar.hpp"

namespace lio {
namespace {

using test::SeenPoint;
using test::TestCloud;

constexpr Timestamp kCloudStamp{1'556'268'000'000'000'000};

CloudRules SecondsFromStamp() {
  CloudRules rules;
  rules.point_time.emplace();  // seconds, stamp + time
  return rules;
}

// Holds a message's bytes and the cloud that is read from them.
struct DecodedMessage {
  explicit DecodedMessage(const TestCloud& cloud)
      : bytes(test::CloudMessage(cloud)),
        decoded(DecodeRosCloud(bytes, RosEncoding::kRos1).value()) {}
  std::vector<std::uint8_t> bytes;
  RosCloud decoded;
};

CloudStatus Convert(const CloudRules& rules, const TestCloud& cloud, TimedSweep& sweep) {
  return CloudToSweep(rules).Convert(DecodedMessage(cloud).decoded, sweep);
}

// Returns three points whose times do not ascend.
TestCloud ThreePoints() {
  return test::VelodyneCloud(kCloudStamp, {{.x = 1, .y = 2, .z = 3, .ring = 7, .time_s = 0.25},
                                           {.x = 4, .y = 5, .z = 6, .ring = 2, .time_s = 0.0},
                                           {.x = 7, .y = 8, .z = 9, .ring = 5, .time_s = 0.125}});
}

TEST(CloudToSweep, PointsAreSortedByTheirInstants) {
  TimedSweep sweep;
  ASSERT_EQ(Convert(SecondsFromStamp(), ThreePoints(), sweep), CloudStatus::kOk);
  EXPECT_EQ(sweep.first, kCloudStamp);
  EXPECT_EQ(sweep.last, kCloudStamp + Duration{250'000'000});
  ASSERT_EQ(sweep.points.size(), 3u);
  EXPECT_EQ(sweep.points[0].x_m, 4.0f);
  EXPECT_EQ(sweep.points[1].x_m, 7.0f);
  EXPECT_EQ(sweep.points[2].x_m, 1.0f);
  EXPECT_EQ(sweep.points[1].y_m, 8.0f);
  EXPECT_EQ(sweep.points[1].z_m, 9.0f);
  EXPECT_EQ(sweep.points[1].t_offset_ns, 125'000'000u);
  EXPECT_EQ(sweep.points[0].intensity, 12);  // as in the cloud: 10 + ring
  EXPECT_EQ(sweep.points[0].ring, 0) << "no rule, no ring";
}

TEST(CloudToSweep, RingsFollowTheirRule) {
  CloudRules rules = SecondsFromStamp();
  rules.ring.source = RingRule::Source::kField;
  rules.ring.ring_of_source = {15, 14, 13, 12, 11, 10, 9, 8};
  TimedSweep sweep;
  ASSERT_EQ(Convert(rules, ThreePoints(), sweep), CloudStatus::kOk);
  EXPECT_EQ(sweep.points[0].ring, 13);  // source ring 2
  EXPECT_EQ(sweep.points[1].ring, 10);  // source ring 5
  EXPECT_EQ(sweep.points[2].ring, 8);   // source ring 7
}

TEST(CloudToSweep, IntensitiesOfZeroToOneAreScaled) {
  CloudRules rules = SecondsFromStamp();
  rules.intensity_scale = 255.0f;
  TestCloud cloud = ThreePoints();
  cloud.Set(1, "intensity", 0.5);
  TimedSweep sweep;
  ASSERT_EQ(Convert(rules, cloud, sweep), CloudStatus::kOk);
  EXPECT_EQ(sweep.points[0].intensity, 128);  // 127.5, rounded
}

TEST(CloudToSweep, WhatIsNoReturnIsLeftOutAndCounted) {
  TestCloud cloud = ThreePoints();
  cloud.Set(0, "y", std::numeric_limits<double>::quiet_NaN());
  for (const char* axis : {"x", "y", "z"}) cloud.Set(1, axis, 0.0);
  const CloudRules rules = SecondsFromStamp();
  CloudToSweep converter(rules);
  TimedSweep sweep;
  ASSERT_EQ(converter.Convert(DecodedMessage(cloud).decoded, sweep), CloudStatus::kOk);
  EXPECT_EQ(sweep.points.size(), 1u);
  EXPECT_EQ(converter.points().num_nonfinite, 1);
  EXPECT_EQ(converter.points().num_zero, 1);
}

TEST(CloudToSweep, ACloudWithoutAReturnIsEmpty) {
  TimedSweep sweep;
  EXPECT_EQ(Convert(SecondsFromStamp(), test::VelodyneCloud(kCloudStamp, {}), sweep),
            CloudStatus::kEmpty);
}

TEST(CloudToSweep, FieldsThatTheOthersHaveMustBeThere) {
  TestCloud no_z = ThreePoints();
  no_z.fields.erase(no_z.fields.begin() + 2);
  TestCloud no_time = ThreePoints();
  no_time.fields.pop_back();
  TimedSweep sweep;
  EXPECT_EQ(Convert(SecondsFromStamp(), no_z, sweep), CloudStatus::kWrongFields);
  EXPECT_EQ(Convert(SecondsFromStamp(), no_time, sweep), CloudStatus::kWrongFields);
}

TEST(CloudToSweep, TimesThatAreNoSweepAreRefused) {
  TestCloud cloud = ThreePoints();
  cloud.Set(0, "time", 0.6);  // a sweep lasts half a second at most
  TimedSweep sweep;
  EXPECT_EQ(Convert(SecondsFromStamp(), cloud, sweep), CloudStatus::kBadTime);
}

// --- without point time: by azimuth

// Returns the lidar's columns one after another, in the order of firing, without delays of single
// rings.
std::vector<SeenPoint> SpunPoints(int k) {
  test::SpinningLidar lidar;
  lidar.firing_s = 0.0;
  return test::SeePoints(lidar, k);
}

CloudRules BySpin(StampMeaning meaning) {
  CloudRules rules;
  rules.spin.direction = -1.0;
  rules.spin.order = PointOrder::kFiring;
  rules.spin.rate_radps = 2.0 * std::numbers::pi / 0.1;
  rules.spin_stamp.meaning = meaning;
  return rules;
}

TEST(CloudToSweep, AzimuthTellsTimeWhereNoFieldDoes) {
  for (const StampMeaning meaning : {StampMeaning::kSweepStart, StampMeaning::kSweepEnd}) {
    const CloudRules rules = BySpin(meaning);
    CloudToSweep converter(rules);
    const std::vector<SeenPoint> seen = SpunPoints(0);
    const double stamp_s = meaning == StampMeaning::kSweepEnd ? seen.back().time_s : 0.0;
    TimedSweep sweep;
    ASSERT_EQ(
        converter.Convert(
            DecodedMessage(test::VelodyneCloud(kCloudStamp + Duration::FromSeconds(stamp_s), seen))
                .decoded,
            sweep),
        CloudStatus::kOk);
    EXPECT_NEAR(SecondsBetween(kCloudStamp, sweep.first), 0.0, 1e-6);
    EXPECT_NEAR(SecondsBetween(kCloudStamp, sweep.last), seen.back().time_s, 1e-6);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      ASSERT_NEAR(1e-9 * sweep.points[i].t_offset_ns, seen[i].time_s, 1e-6) << i;
    }
  }
}

// At 0.7 Hz a turn lasts longer than any sweep may.
TEST(CloudToSweep, ASpinTooSlowForASweepIsRefused) {
  CloudRules rules = BySpin(StampMeaning::kSweepStart);
  rules.spin.rate_radps = 2.0 * std::numbers::pi * 0.7;
  TimedSweep sweep;
  EXPECT_EQ(Convert(rules, test::VelodyneCloud(kCloudStamp, SpunPoints(0)), sweep),
            CloudStatus::kBadTime);
}

}  // namespace
}  // namespace lio
