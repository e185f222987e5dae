// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/inspvax.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace lio {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// This is 2019-01-17 03:00:00 UTC: GPS week 2036, a Thursday.
constexpr Timestamp kThursdayMorning{1'547'694'000'000'000'000};
constexpr double kWeek = 2036.0;
constexpr double kSecondsOfWeek = 4 * 86'400 + 3 * 3'600 + 18.0;

RosNumbers Oem7() {
  return {{"nov_header.gps_week_number", kWeek},
          {"nov_header.gps_week_milliseconds", 1e3 * kSecondsOfWeek + 250.0},
          {"ins_status.status", 3.0},
          {"latitude", 22.3},
          {"longitude", 114.2},
          {"height", 5.0},
          {"undulation", -2.5},
          {"roll", 1.0},
          {"pitch", -2.0},
          {"azimuth", 90.0}};
}

TEST(Inspvax, StampIsUtcOfGpsTime) {
  const auto row = ToInspvaxRow(Oem7(), kThursdayMorning);
  ASSERT_TRUE(row);
  EXPECT_NEAR(SecondsBetween(kThursdayMorning, row->stamp), 0.25, 1e-9);
  EXPECT_EQ(row->ins_status, kInsSolutionGood);
  EXPECT_NEAR(row->latitude_rad, 22.3 * kDegree, 1e-12);
  EXPECT_NEAR(row->ellipsoid_height_m, 2.5, 1e-12);
}

TEST(Inspvax, ReadsOtherDriversNamesAndUnits) {
  // novatel_msgs has the status as four bytes, and milliseconds in a field named seconds.
  RosNumbers numbers = Oem7();
  for (const char* name : {"nov_header.gps_week_number", "nov_header.gps_week_milliseconds",
                           "ins_status.status", "height"}) {
    numbers.erase(name);
  }
  numbers["header.gps_week"] = kWeek;
  numbers["header.gps_week_seconds"] = 1e3 * kSecondsOfWeek;
  numbers["status[0]"] = 3.0;
  for (const char* name : {"status[1]", "status[2]", "status[3]"}) numbers[name] = 0.0;
  numbers["altitude"] = 5.0;
  const auto milliseconds = ToInspvaxRow(numbers, kThursdayMorning);
  ASSERT_TRUE(milliseconds);
  EXPECT_NEAR(SecondsBetween(kThursdayMorning, milliseconds->stamp), 0.0, 1e-9);
  EXPECT_EQ(milliseconds->ins_status, 3);
  numbers["header.gps_week_seconds"] = kSecondsOfWeek;
  const auto seconds = ToInspvaxRow(numbers, kThursdayMorning);
  ASSERT_TRUE(seconds);
  EXPECT_NEAR(SecondsBetween(kThursdayMorning, seconds->stamp), 0.0, 1e-9);
}

TEST(Inspvax, RefusesRowsWithHoles) {
  for (const auto& [name, value] : Oem7()) {
    if (name == "undulation") continue;
    RosNumbers numbers = Oem7();
    numbers.erase(name);
    EXPECT_FALSE(ToInspvaxRow(numbers, kThursdayMorning)) << name;
  }
  RosNumbers numbers = Oem7();
  numbers["latitude"] = 1e300;
  EXPECT_FALSE(ToInspvaxRow(numbers, kThursdayMorning));
}

TEST(Inspvax, KnowsLeapSeconds) {
  EXPECT_EQ(LeapSeconds(1'167'264'017), 17);
  EXPECT_EQ(LeapSeconds(1'167'264'018), 18);
  EXPECT_EQ(LeapSeconds(1'100'000'000), 16);
  EXPECT_EQ(LeapSeconds(0), 13);
}

TEST(Inspvax, AttitudeMapsNovatelsBodyToEastNorthUp) {
  // The body heads east: its y (forward) points east, its x (right) south.
  const Quaternion east = InspvaxAttitude(0.0, 0.0, 90.0 * kDegree);
  EXPECT_TRUE((east * Vector3::UnitY()).isApprox(Vector3::UnitX(), 1e-12));
  EXPECT_TRUE((east * Vector3::UnitX()).isApprox(-Vector3::UnitY(), 1e-12));
  // Forward rises when the nose is up, and x sinks when the right side is down.
  EXPECT_NEAR((InspvaxAttitude(0.0, 0.1, 0.0) * Vector3::UnitY()).z(), std::sin(0.1), 1e-12);
  EXPECT_NEAR((InspvaxAttitude(0.1, 0.0, 0.0) * Vector3::UnitX()).z(), -std::sin(0.1), 1e-12);
}

TEST(LocalFrame, IsEastNorthUpAtItsFirstPoint) {
  LocalFrame frame;
  const double latitude = 22.3 * kDegree;
  const double longitude = 114.2 * kDegree;
  EXPECT_TRUE(frame.ToLocal(latitude, longitude, 10.0).isZero(1e-9));
  // These are the radii of curvature of WGS84 at that latitude.
  constexpr double kMeridian = 6'344'627.0;
  constexpr double kAcross = 6'381'212.0;
  const Vector3 north = frame.ToLocal(latitude + 1e-5, longitude, 10.0);
  EXPECT_NEAR(north.y(), 1e-5 * (kMeridian + 10.0), 0.01);
  EXPECT_NEAR(north.x(), 0.0, 1e-6);
  const Vector3 east = frame.ToLocal(latitude, longitude + 1e-5, 10.0);
  EXPECT_NEAR(east.x(), 1e-5 * (kAcross + 10.0) * std::cos(latitude), 0.01);
  EXPECT_NEAR(frame.ToLocal(latitude, longitude, 13.0).z(), 3.0, 1e-9);
}

TEST(Inspvax, KnowsADefinitionForBagsWithoutOne) {
  const char* definition = KnownInspvaxDefinition("novatel_oem7_msgs/INSPVAX");
  ASSERT_NE(definition, nullptr);
  EXPECT_TRUE(RosSchema::Parse(definition, "novatel_oem7_msgs/INSPVAX"));
  EXPECT_EQ(KnownInspvaxDefinition("other_msgs/INSPVAX"), nullptr);
}

}  // namespace
}  // namespace lio
