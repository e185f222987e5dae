// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the initialization, at rest and in motion.
#include <gtest/gtest.h>

#include "lio/pipeline/odometry.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::DriveOptions;
using test::Driving;
using test::ErrorAgainst;
using test::ExpectClean;
using test::ExpectStampsIncrease;
using test::HasNotice;
using test::IsBetween;
using test::LidarOnly;
using test::MakeBlind;
using test::Message;
using test::Messages;
using test::MovingStartDrive;
using test::RestThenDrive;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;
using test::StaticStartDrive;
using test::TrackError;

// Returns the end of the first row's sweep since the drive's begin.
double FirstRow(const RunResult& run) {
  return run.scans.empty() ? 1e9 : SecondsOf(run.scans.front().scan.stamp);
}

Messages Until(const Messages& messages, double to_s) {
  return test::Where(messages, [=](const Message& m) { return IsBetween(m, -1e3, to_s); });
}

// --- at rest

TEST(OdometryStart, StaticStartTracksTheDrive) {
  const RunResult run = RunOdometry(StaticStartDrive(), test::DriveRig());
  ASSERT_FALSE(run.scans.empty());
  ExpectClean(run.counters);
  ExpectStampsIncrease(run);
  EXPECT_TRUE(test::HasNotice(run, "at rest"));
  EXPECT_LT(SecondsOf(run.scans.front().scan.stamp), 1.5) << "rows after 1.5 s of rest at most";
  const TrackError error = ErrorAgainst(RestThenDrive(), run.scans);
  EXPECT_LT(error.max_m, 0.06);
  EXPECT_LT(error.max_rad, 0.005);
  EXPECT_LT(error.max_tilt_rad, 0.009);  // half a degree
  EXPECT_EQ(run.status, TrackingStatus::kOk);
}

TEST(OdometryStart, ARestAsLongAsAskedForIsUsed) {
  const Messages rest = Until(StaticStartDrive(), 1.5);
  for (const double rest_s : {0.5, 1.0, 1.3}) {
    Options options = test::DriveRig();
    options.start.rest_s = rest_s;
    const RunResult run = RunOdometry(rest, options);
    EXPECT_GE(FirstRow(run), rest_s - 0.01);
    EXPECT_LE(FirstRow(run), rest_s + 0.21) << "within two sweeps";
    EXPECT_EQ(run.status, TrackingStatus::kOk);
  }
}

TEST(OdometryStart, BeforeItThereIsNothingToTell) {
  const RunResult run = RunOdometry(Until(StaticStartDrive(), 0.8), test::DriveRig());
  EXPECT_TRUE(run.scans.empty());
  EXPECT_TRUE(run.navs.empty());
  EXPECT_EQ(run.status, TrackingStatus::kInit);
}

// A parked car whose engine shakes the gyro by 0.05 rad/s, more than counts as calm.
TEST(OdometryStart, ShakenRestIsWaitedForAndThenTaken) {
  DriveOptions drive;
  drive.motion = test::WindingDrive(10.0);
  drive.to_s = 2.0;
  drive.gyro_density = 0.005;
  const RunResult run = RunOdometry(SimulateDrive(test::Street(), drive), test::DriveRig());
  EXPECT_TRUE(HasNotice(run, "waiting for rest: gyro spread"));
  EXPECT_GE(FirstRow(run), 1.39);
  EXPECT_LE(FirstRow(run), 1.61);
  EXPECT_TRUE(HasNotice(run, "at rest"));
}

TEST(OdometryStart, FirstSweepsWithoutAFinitePointAreSurvived) {
  for (const Options& options : {test::DriveRig(), LidarOnly()}) {
    Messages messages = StaticStartDrive();
    for (Message& message : messages) {
      if (IsBetween(message, -1.0, 0.35)) MakeBlind(message);
    }
    const RunResult run = RunOdometry(messages, options);
    ASSERT_FALSE(run.scans.empty());
    EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans, 1.0).max_m, 0.16);
  }
}

// --- in motion

TEST(OdometryStart, MovingStartTracksTheDrive) {
  const RunResult run = RunOdometry(MovingStartDrive(), test::DriveRig());
  ASSERT_FALSE(run.scans.empty());
  EXPECT_TRUE(test::HasNotice(run, "in motion"));
  ExpectStampsIncrease(run);
  EXPECT_EQ(run.counters.num_restarts, 0);
  EXPECT_LT(ErrorAgainst(Driving(), run.scans).max_m, 0.3);
  const TrackError settled = ErrorAgainst(Driving(), run.scans, 3.0);
  EXPECT_LT(settled.max_m, 0.1);
  EXPECT_LT(settled.max_tilt_rad, 0.0175);  // a degree, after 3 s
  const NavOutput& last = run.scans.back().filter->nav;
  const test::MotionState truth = test::StateOf(Driving(), SecondsOf(last.stamp));
  const Vector3 v_imu = last.T_world_imu.rotation.conjugate() * last.v_world_imu_mps;
  EXPECT_LT((v_imu - truth.T_world_imu.rotation.conjugate() * truth.v_world_imu).norm(), 0.2);
}

TEST(OdometryStart, InMotionAWindowAsLongAsAskedForIsAligned) {
  const Messages drive = MovingStartDrive(4.5);
  for (const double window_s : {1.5, 3.0}) {
    Options options = test::DriveRig();
    options.start.moving_window_s = window_s;
    const RunResult run = RunOdometry(drive, options);
    ASSERT_FALSE(run.scans.empty()) << window_s;
    EXPECT_TRUE(HasNotice(run, "in motion"));
    // Rows go back to where the window begins, and come only once it is over.
    EXPECT_LT(FirstRow(run), 1.0);
    EXPECT_TRUE(RunOdometry(Until(drive, window_s - 0.1), options).scans.empty()) << window_s;
  }
}

TEST(OdometryStart, InMotionRestIsAwaitedAsLongAsAskedFor) {
  Options options = test::DriveRig();
  options.start.wait_for_rest_s = 3.5;
  const Messages drive = MovingStartDrive(5.0);
  const RunResult run = RunOdometry(drive, options);
  EXPECT_TRUE(HasNotice(run, "in motion: waiting for rest"));
  ASSERT_FALSE(run.scans.empty());
  EXPECT_GE(FirstRow(run), 1.4);
  EXPECT_TRUE(RunOdometry(Until(drive, 3.3), options).scans.empty());
}

// Rates in degrees a second, where the rig says radians, do not fit what the lidar sees: no start,
// and a reason.
TEST(OdometryStart, ARigThatDoesNotFitIsNotStartedWith) {
  Messages messages = MovingStartDrive(4.5);
  for (Message& message : messages) message.sample.w_imu_radps *= 180.0 / M_PI;
  Options options = test::DriveRig();
  options.rig.imu.units = ImuUnits::kSi;
  const RunResult run = RunOdometry(messages, options);
  EXPECT_TRUE(run.scans.empty());
  EXPECT_TRUE(HasNotice(run, "set rig.imu.units: auto"));
}

// --- by the lidar alone

TEST(OdometryStart, TheLidarAloneTracksFromTheFirstSweepOn) {
  const RunResult run = RunOdometry(MovingStartDrive(2.0), LidarOnly());
  ASSERT_FALSE(run.scans.empty());
  EXPECT_EQ(run.scans.front().scan.scan_seq, 0);
  EXPECT_LT(ErrorAgainst(Driving(), run.scans, 0.35).max_m, 0.3);
}

// --- ring lock (docs/filter.md): a map filled by a parked sensor shows single scan rings

TEST(OdometryStart, ParkedStartDoesNotHoldTheVehicleBack) {
  DriveOptions drive;
  drive.motion = test::WindingDrive(4.0);
  drive.to_s = 8.5;
  const RunResult run = RunOdometry(SimulateDrive(test::Street(), drive), test::DriveRig());
  EXPECT_LT(ErrorAgainst(drive.motion, run.scans).max_m, 0.05);
  EXPECT_EQ(run.counters.num_gated, 0);
}

TEST(OdometryStart, ParkedStartInACorridorDoesNotHoldTheVehicleBack) {
  DriveOptions drive;
  drive.motion = test::StraightDrive(4.0);
  drive.to_s = 7.5;
  const RunResult run = RunOdometry(SimulateDrive(test::Corridor(), drive), test::DriveRig());
  // Nothing holds the vehicle along the corridor but the IMU: centimetres a second squared.
  EXPECT_LT(ErrorAgainst(drive.motion, run.scans).max_m, 0.4);
}

}  // namespace
}  // namespace lio
