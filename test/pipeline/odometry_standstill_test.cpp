// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimator while the vehicle stands still.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::DriveOptions;
using test::Messages;
using test::MovingStartDrive;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;

Messages DriveAlong(const test::Motion& motion, double to_s) {
  DriveOptions drive;
  drive.motion = motion;
  drive.to_s = to_s;
  return SimulateDrive(test::Street(), drive);
}

// The body goes to and fro by 3 mm/s, as in a wind.
Pose SwayingOnItsSprings(double t_s) {
  const Vector3 sway_m(8e-4 * std::sin(4.1 * t_s + 1.0), 6e-4 * std::sin(3.1 * t_s), 0.0);
  return {Quaternion::Identity(), sway_m};
}

TEST(Odometry, AtRestTheVelocityIsZeroAndItsCovarianceDoesNotCollapse) {
  const RunResult run = RunOdometry(DriveAlong(SwayingOnItsSprings, 12.0), test::DriveRig());
  EXPECT_GT(run.counters.num_standstills, 80);
  const NavOutput& start = run.scans.front().filter->nav;
  for (const NavOutput& nav : run.navs) {
    EXPECT_LT(nav.v_world_imu_mps.norm(), 0.01);
    EXPECT_LT((nav.T_world_imu.translation - start.T_world_imu.translation).norm(), 0.02);
  }
  const auto velocity_std = [&](double t_s) {
    for (const ScanOutput& scan : run.scans) {
      if (SecondsOf(scan.scan.stamp) > t_s) {
        return std::sqrt(scan.filter->nav.velocity_cov.trace() / 3.0);
      }
    }
    return 0.0;
  };
  EXPECT_GT(velocity_std(11.0), 5e-4);
  EXPECT_GT(velocity_std(11.0), 0.5 * velocity_std(6.0));
}

// 5 mm/s^2 for 2 s, which nobody feels, then 10 mm/s.
Pose Creeping(double t_s) {
  const double since_s = std::max(0.0, t_s - 4.0);
  const double faster_s = std::min(since_s, 2.0);
  const double way_m = 0.0025 * faster_s * faster_s + 0.01 * (since_s - faster_s);
  return {Quaternion::Identity(), Vector3(way_m, 0.0, 0.0)};
}

TEST(Odometry, ACreepThatIsTakenForRestIsFollowed) {
  const RunResult run = RunOdometry(DriveAlong(Creeping, 20.0), test::DriveRig());
  EXPECT_GT(run.counters.num_standstills, 150);
  EXPECT_LT(test::ErrorAgainst(Creeping, run.scans).max_m, 0.01);
}

TEST(Odometry, InMotionNoStandstillIsFused) {
  const RunResult run = RunOdometry(MovingStartDrive(), test::DriveRig());
  EXPECT_EQ(run.counters.num_standstills, 0);
}

TEST(Odometry, StandstillEndsWhenTheVehicleDrivesOff) {
  const Messages messages = DriveAlong(test::WindingDrive(4.0), 8.5);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_GT(run.counters.num_standstills, 10);
  EXPECT_LE(run.counters.num_standstills, 41) << "scans taken before it drives off";
  Options without = test::DriveRig();
  without.filter.use_zero_velocity = false;
  EXPECT_EQ(RunOdometry(messages, without).counters.num_standstills, 0);
}

}  // namespace
}  // namespace lio
