// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The lidar alone, where the way is lost from sight.
#include <gtest/gtest.h>

#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::ErrorAgainst;
using test::HasNotice;
using test::IsBetween;
using test::kEnd_s;
using test::LidarOnly;
using test::Message;
using test::Messages;
using test::RestThenDrive;
using test::RunOdometry;
using test::RunResult;
using test::StaticStartDrive;
using test::WithoutLidar;

TEST(OdometryLidarOnly, FindsItsWayBackAfterASecondUnseen) {
  const RunResult run = RunOdometry(WithoutLidar(StaticStartDrive(), 4.0, 5.0), LidarOnly());
  EXPECT_EQ(run.counters.num_restarts, 0);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 0.15);
}

Messages WithClouds(double from_s, double to_s) {
  Messages messages = StaticStartDrive();
  test::ShowClouds(from_s, to_s, messages);
  return messages;
}

TEST(OdometryLidarOnly, BeginsAMapAnewWhereThePathWasWhenLost) {
  const RunResult run = RunOdometry(WithClouds(4.0, 4.7), LidarOnly());
  EXPECT_GE(run.counters.num_restarts, 1);
  EXPECT_GE(run.counters.num_lost, 1);
  EXPECT_TRUE(HasNotice(run, "the map begins anew"));
  EXPECT_EQ(run.status, TrackingStatus::kOk);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 5.0);  // 6 m were driven unseen
  ASSERT_TRUE(run.scans.back().filter);
  const NavOutput& end = run.scans.back().filter->nav;
  EXPECT_GT(end.pose_cov(0, 0), 0.2);                         // in the world it is not sure ...
  EXPECT_LT(end.map_pose_cov(0, 0), end.pose_cov(0, 0) / 4);  // ... but in its map
}

TEST(OdometryLidarOnly, AScanFoundNowhereIsNotInTheMap) {
  const RunResult run = RunOdometry(WithClouds(4.0, 4.2), LidarOnly());
  EXPECT_EQ(run.counters.num_restarts, 0);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 0.1);
}

// The lidar's driver is up first.
TEST(OdometryLidarOnly, AnInertialUnitThatComesLaterIsUsed) {
  const Messages messages = test::WithoutImu(StaticStartDrive(), -1.0, 2.6);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_TRUE(HasNotice(run, "no inertial samples come: lidar-only odometry"));
  EXPECT_TRUE(HasNotice(run, "inertial samples have come"));
  EXPECT_TRUE(HasNotice(run, "started in motion"));
  test::ExpectStampsIncrease(run);
  ASSERT_FALSE(run.navs.empty());
  EXPECT_EQ(run.status, TrackingStatus::kOk);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 0.5);
  for (const int lag : {1, 5, 20}) {
    EXPECT_EQ(test::Bytes(RunOdometry(messages, test::DriveRig(), lag).scans),
              test::Bytes(run.scans))
        << lag;
  }
}

TEST(OdometryLidarOnly, AnInertialUnitThatComesForAMomentLeavesThePathWhereItWas) {
  const Messages without_first = test::WithoutImu(StaticStartDrive(), -1.0, 4.0);
  const RunResult run =
      RunOdometry(test::WithoutImu(without_first, 4.7, kEnd_s + 1.0), test::DriveRig());
  ASSERT_TRUE(HasNotice(run, "inertial samples have come"));
  ASSERT_TRUE(HasNotice(run, "no inertial samples come any more"));
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).end_m, 1.0);
}

// On a body that is pitched by 6 degrees, which the lidar alone cannot know.
TEST(OdometryLidarOnly, AnInertialUnitThatComesLaterLevelsTheWorldAndLeavesTheMap) {
  const Pose pitched{ExpSo3(Vector3(0, 0.1, 0)), Vector3::Zero()};
  test::DriveOptions drive;
  drive.motion = [pitched](double t_s) { return RestThenDrive()(t_s) * pitched; };
  drive.to_s = kEnd_s;
  const Messages messages = test::WithoutImu(test::SimulateDrive(test::Street(), drive), -1.0, 2.6);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  ASSERT_TRUE(HasNotice(run, "started in motion"));
  EXPECT_EQ(run.status, TrackingStatus::kOk);
  const test::TrackError error = ErrorAgainst(drive.motion, run.scans);
  EXPECT_LT(error.end_m, 0.5);
  EXPECT_LT(error.max_rad, 0.02) << "the map keeps its attitude";
  const NavOutput& last = run.scans.back().filter->nav;
  const Vector3 up = last.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  const Vector3 up_of_map = last.T_map_imu.rotation.conjugate() * Vector3::UnitZ();
  const Pose truth = drive.motion(test::SecondsOf(last.stamp));
  const Vector3 true_up = truth.rotation.conjugate() * Vector3::UnitZ();
  EXPECT_LT((up - true_up).norm(), 0.02);
  EXPECT_NEAR((up_of_map - true_up).norm(), 0.1, 0.03);
}

TEST(OdometryLidarOnly, AStrayInertialSampleChangesNothing) {
  Messages messages = test::WithoutImu(StaticStartDrive(), -1.0, kEnd_s);
  const std::size_t num_scans = RunOdometry(messages, test::DriveRig()).scans.size();
  for (Message& message : messages) {
    if (!IsBetween(message, 4.0, 4.05)) continue;
    message.is_imu = true;
    message.sample.stamp = message.arrival;
    break;
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_FALSE(HasNotice(run, "inertial samples have come"));
  EXPECT_GE(run.scans.size() + 1, num_scans);
}

TEST(OdometryLidarOnly, AnInertialUnitByAnotherClockLeavesTheLidarAlone) {
  const Messages lidar = test::WithoutImu(StaticStartDrive(), -1.0, kEnd_s);
  const Messages late = test::WithoutImu(StaticStartDrive(), -1.0, 2.6);
  const RunResult run =
      RunOdometry(test::WithClockStep(late, -1.0, -1000.0, true, false), test::DriveRig());
  EXPECT_TRUE(HasNotice(run, "s after the inertial samples"));
  EXPECT_FALSE(HasNotice(run, "inertial samples have come"));
  EXPECT_EQ(test::Bytes(run.scans), test::Bytes(RunOdometry(lidar, test::DriveRig()).scans));
}

TEST(OdometryLidarOnly, ItNeedsNoOffsetBetweenClocks) {
  Options options = test::DriveRig();
  options.filter.estimate_clock_offset = true;
  const RunResult run = RunOdometry(test::WithoutImu(StaticStartDrive(), -1.0, kEnd_s), options);
  EXPECT_EQ(run.status, TrackingStatus::kOk);
}

}  // namespace
}  // namespace lio
