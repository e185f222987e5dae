// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/truth_source.hpp"

#include <gtest/gtest.h>

#include "lio/io/input_error.hpp"
#include "lio/io/trajectory_file.hpp"
#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::RosBytes;

constexpr Timestamp kTruthStamp{1'547'694'000'000'000'000};

// This is the variant of UrbanNav's driver.
constexpr const char* kInspvaxDefinition = R"(novatel_msgs/CommonHeader header
uint32 ins_status
uint32 INS_STATUS_SOLUTION_GOOD=3
uint32 position_type
float64 latitude
float64 longitude
float64 altitude
float32 undulation
float64 roll
float64 pitch
float64 azimuth
================================================================================
MSG: novatel_msgs/CommonHeader
uint16 id
uint8 msg_type
uint16 gps_week
uint32 gps_week_seconds
)";

std::vector<std::uint8_t> Inspvax(double seconds, int status, double latitude) {
  RosBytes bytes;
  bytes.Put(std::uint16_t{1465}).Put(std::uint8_t{2}).Put(std::uint16_t{2036});
  const double of_week = 4 * 86'400 + 3 * 3'600 + 18.0 + seconds;
  bytes.Put(static_cast<std::uint32_t>(1e3 * of_week));
  bytes.Put(static_cast<std::uint32_t>(status)).Put(std::uint32_t{56});
  bytes.Put(latitude).Put(114.2).Put(5.0).Put(-2.5f).Put(0.0).Put(0.0).Put(0.0);
  return bytes.bytes();
}

class Truth : public testing::Test {
 protected:
  void Add(TruthSource& truth, const std::vector<std::uint8_t>& data, double seconds) {
    truth.Add({0, kTruthStamp + Duration::FromSeconds(seconds), data});
  }
  test::TempDir dir_;
  std::filesystem::path tum_ = dir_.path() / "truth.tum";
};

TEST_F(Truth, OfOdometryAndPosesIsCopied) {
  const StampedPose pose{kTruthStamp, {ExpSo3({0.0, 0.0, 0.5}), {1.0, 2.0, 3.0}}};
  for (const bool odometry : {true, false}) {
    TruthSource truth({"/t", odometry ? "nav_msgs/Odometry" : "geometry_msgs/PoseStamped", "",
                       RosEncoding::kRos1, 0},
                      tum_);
    Add(truth, odometry ? test::OdometryMessage(pose) : test::PoseMessage(pose), 0.1);
    truth.Close();
    const Trajectory read = ReadTrajectory(tum_);
    ASSERT_EQ(read.poses.size(), 1u);
    EXPECT_EQ(read.poses[0].stamp, kTruthStamp);
    EXPECT_NEAR((read.poses[0].pose.translation - pose.pose.translation).norm(), 0.0, 1e-8);
  }
}

TEST_F(Truth, LeavesOutAndCountsWhatIsNotIncreasingOrDamaged) {
  TruthSource truth({"/t", "nav_msgs/Odometry", "", RosEncoding::kRos1, 0}, tum_);
  Add(truth, test::OdometryMessage({kTruthStamp, {}}), 0.0);
  Add(truth, test::OdometryMessage({kTruthStamp, {}}), 0.1);
  Add(truth, {1, 2, 3}, 0.2);
  truth.Close();
  EXPECT_EQ(truth.counts().num_rows, 1);
  EXPECT_EQ(truth.counts().num_not_later, 1);
  EXPECT_EQ(truth.counts().num_damaged, 1);
}

TEST_F(Truth, OfInspvaxKeepsGoodRowsInEastNorthUp) {
  TruthSource truth({"/inspvax", "novatel_msgs/INSPVAX", kInspvaxDefinition, RosEncoding::kRos1, 0},
                    tum_);
  Add(truth, Inspvax(0.0, 1, 22.2), 0.05);  // the INS is aligning, so this is no origin either
  Add(truth, Inspvax(1.0, 3, 22.3), 1.05);
  Add(truth, Inspvax(2.0, 3, 22.3001), 2.05);
  Add(truth, {9, 9}, 3.0);
  truth.Close();
  EXPECT_EQ(truth.counts().num_not_good, 1);
  EXPECT_EQ(truth.counts().num_damaged, 1);
  const Trajectory read = ReadTrajectory(tum_);
  ASSERT_EQ(read.poses.size(), 2u);
  EXPECT_EQ(read.poses[0].stamp, kTruthStamp + Duration::FromSeconds(1.0));
  EXPECT_NEAR(read.poses[0].pose.translation.norm(), 0.0, 1e-9);
  EXPECT_NEAR(read.poses[1].pose.translation.y(), 11.07, 0.01);  // a ten-thousandth of a degree
  EXPECT_NEAR(truth.counts().delay_sum_s / 2.0, 0.05, 1e-6);
}

TEST_F(Truth, OfInspvaxNeedsADefinition) {
  EXPECT_THROW(TruthSource({"/i", "novatel_msgs/INSPVAX", "", RosEncoding::kRos1, 0}, tum_),
               InputError);
  EXPECT_THROW(TruthSource({"/i", "novatel_msgs/INSPVAX", "???", RosEncoding::kRos1, 0}, tum_),
               InputError);
  EXPECT_NO_THROW(TruthSource({"/i", "novatel_oem7_msgs/INSPVAX", "", RosEncoding::kCdr, 0}, tum_));
}

TEST_F(Truth, OfOem7InspvaxWithoutStoredDefinitionIsRead) {
  RosBytes bytes(RosEncoding::kCdr);
  bytes.PutHeader(kTruthStamp, "gps").PutString("INSPVAXA").Put(std::uint16_t{1465});
  bytes.Put(std::uint8_t{0}).Put(std::uint32_t{7}).Put(std::uint8_t{180}).Put(std::uint16_t{2036});
  bytes.Put(std::uint32_t{(4 * 86'400 + 3 * 3'600 + 18) * 1000});
  bytes.Put(std::uint32_t{3}).Put(std::uint32_t{56});
  bytes.Put(22.3).Put(114.2).Put(5.0).Put(-2.5f).PutZeros(6);
  for (int i = 0; i < 9; ++i) bytes.Put(0.1f);
  bytes.Put(std::uint32_t{0}).Put(std::uint16_t{0});
  TruthSource truth({"/i", "novatel_oem7_msgs/INSPVAX", "", RosEncoding::kCdr, 0}, tum_);
  Add(truth, bytes.bytes(), 0.0);
  truth.Close();
  EXPECT_EQ(truth.counts().num_rows, 1);
  EXPECT_EQ(truth.counts().first, kTruthStamp);
}

TEST(TruthType, IsKnownByName) {
  EXPECT_TRUE(IsTruthType("nav_msgs/Odometry"));
  EXPECT_TRUE(IsTruthType("any_msgs/INSPVAX"));
  EXPECT_FALSE(IsTruthType("sensor_msgs/Imu"));
}

}  // namespace
}  // namespace lio
