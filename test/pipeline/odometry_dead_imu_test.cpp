// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the estimator as a whole where a sensor of the IMU breaks on the way and goes on sending.
#include <gtest/gtest.h>

#include <functional>

#include "lio/pipeline/odometry.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Bytes;
using test::ErrorAgainst;
using test::Messages;
using test::RestThenDrive;
using test::RunOdometry;
using test::RunResult;
using test::SecondsOf;

using Spoil = std::function<void(ImuSample&)>;

constexpr double kBroken_s = 8.0;  // by then it is known what the messages mean
constexpr double kLongEnd_s = 18.0;

Messages LongDrive() {
  static const Messages kMessages = [] {
    test::DriveOptions options;
    options.motion = RestThenDrive();
    options.to_s = kLongEnd_s;
    return SimulateDrive(test::Street(), options);
  }();
  return kMessages;
}

Messages Broken(const Spoil& spoil, double until_s = kLongEnd_s, double from_s = kBroken_s) {
  Messages messages = LongDrive();
  for (test::Message& message : messages) {
    const double t_s = message.is_imu ? SecondsOf(message.sample.stamp) : 0.0;
    if (t_s >= from_s && t_s < until_s) spoil(message.sample);
  }
  return messages;
}

void KillGyro(ImuSample& sample) {
  sample.w_imu_radps.setZero();
}
void KillAccelerometer(ImuSample& sample) {
  sample.f_imu_mps2.setZero();
}
void KillBoth(ImuSample& sample) {
  KillGyro(sample);
  KillAccelerometer(sample);
}
void StopYaw(ImuSample& sample) {
  sample.w_imu_radps.z() = 0.0;
}
void ShiftRate(ImuSample& sample) {
  sample.w_imu_radps.z() += 0.06;
}
void JumpRate(ImuSample& sample) {
  sample.w_imu_radps.z() += 0.3;
}
void ShiftForce(ImuSample& sample) {
  sample.f_imu_mps2.x() += 1.0;
}

struct Fault {
  const char* name;
  void (*spoil)(ImuSample&);
  const char* notice;
};

class DeadImu : public testing::TestWithParam<Fault> {};

TEST_P(DeadImu, ScansGoOnAlone) {
  const RunResult run = RunOdometry(Broken(GetParam().spoil), test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, GetParam().notice));
  EXPECT_TRUE(test::HasNotice(run, "lidar-only odometry until the IMU follows the scans again"));
  EXPECT_FALSE(test::HasNotice(run, "follows the motion again"));
  EXPECT_EQ(run.counters.num_restarts, 1);
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.2);
  EXPECT_EQ(run.status, TrackingStatus::kOk);
  const auto is_ok = [](const ScanOutput& output) {
    return output.filter->nav.status == TrackingStatus::kOk;
  };
  EXPECT_GE(std::ranges::count_if(run.scans, is_ok), std::ssize(run.scans) - 8);
}

TEST_P(DeadImu, ChangesNothingForASlowMatcher) {
  const Messages messages = Broken(GetParam().spoil);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_EQ(Bytes(RunOdometry(messages, test::DriveRig(), 20).scans), Bytes(run.scans));
}

TEST_P(DeadImu, IsBelievedAgainOnceItFollowsTheScans) {
  const RunResult run = RunOdometry(Broken(GetParam().spoil, kBroken_s + 1.0), test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, "the IMU follows the motion again"));
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.2);
  ASSERT_FALSE(run.navs.empty());
  EXPECT_GT(SecondsOf(run.navs.back().stamp), kLongEnd_s - 0.5);
}

// So large a jump bends the scans. The drive has shown by then that the rig is right.
TEST(DeadImuLater, AGyroThatJumpsFarIsFoundBeforeTheWayIsLost) {
  const RunResult run =
      RunOdometry(Broken(JumpRate, kLongEnd_s, kLongEnd_s - 4.0), test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, "the gyro is 0."));
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.2);
  EXPECT_EQ(run.status, TrackingStatus::kOk);
}

INSTANTIATE_TEST_SUITE_P(
    All, DeadImu,
    testing::Values(Fault{"Gyro", KillGyro, "an axis of the gyro reads the same all the time"},
                    Fault{"Accelerometer", KillAccelerometer,
                          "an axis of the accelerometer reads the same all the time"},
                    Fault{"Both", KillBoth, "reads the same all the time"},
                    Fault{"YawRate", StopYaw, "an axis of the gyro reads the same all the time"},
                    Fault{"RateOff", ShiftRate, "the gyro is 0.0"},
                    Fault{"ForceOff", ShiftForce, "the accelerometer is "}),
    [](const auto& test) { return std::string(test.param.name); });

// Sweeps of clouds of points lose the way while the unit is dead.
TEST(DeadImuAndLost, IsBelievedAgainOnceItFollowsTheScans) {
  Messages messages = Broken(KillBoth, kBroken_s + 1.5);
  test::ShowClouds(kBroken_s + 0.5, kBroken_s + 1.2, messages);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_GE(run.counters.num_lost, 1);
  EXPECT_TRUE(test::HasNotice(run, "the IMU follows the motion again"));
  ASSERT_FALSE(run.navs.empty());
  EXPECT_GT(SecondsOf(run.navs.back().stamp), kLongEnd_s - 0.5);
}

TEST(DeadImuAndClocksSetBack, IsBelievedAgainOnceItFollowsTheScans) {
  const Messages messages =
      test::WithClockStep(Broken(KillBoth, kBroken_s + 2.0), kBroken_s + 1.0, -600.0);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, "reads the same all the time"));
  EXPECT_TRUE(test::HasNotice(run, "the IMU follows the motion again"));
  ASSERT_FALSE(run.navs.empty());
  EXPECT_GT(SecondsOf(run.navs.back().stamp), kLongEnd_s - 600.5);
}

// Scans show nothing while the rate jumps, so that nothing accuses the gyro before the way is lost.
TEST(GyroThatJumpsAndLost, StartsAnewWithTheBiasThatItHasNow) {
  Messages messages = Broken(ShiftRate);
  test::ShowClouds(kBroken_s - 0.2, kBroken_s + 2.8, messages);
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_GE(run.counters.num_lost, 1);
  EXPECT_TRUE(test::HasNotice(run, "the gyro's bias is now 0.0"));
  EXPECT_EQ(run.status, TrackingStatus::kOk);
  ASSERT_FALSE(run.navs.empty());
  EXPECT_GT(SecondsOf(run.navs.back().stamp), kLongEnd_s - 0.5);
  EXPECT_NEAR(run.scans.back().filter->gyro_bias_radps.z(), 0.06, 0.01);
}

// The accelerometer is contradicted, and then the gyro dies as well.
TEST(DeadImuOneByOne, IsBelievedAgainOnceBothFollowTheScans) {
  Messages messages = Broken(ShiftForce, kBroken_s + 2.0);
  for (test::Message& message : messages) {
    const double t_s = message.is_imu ? SecondsOf(message.sample.stamp) : 0.0;
    if (t_s >= kBroken_s + 1.3 && t_s < kBroken_s + 2.0) KillGyro(message.sample);
  }
  const RunResult run = RunOdometry(messages, test::DriveRig());
  EXPECT_TRUE(test::HasNotice(run, "the accelerometer is "));
  EXPECT_TRUE(test::HasNotice(run, "the IMU follows the motion again"));
  EXPECT_LT(ErrorAgainst(RestThenDrive(), run.scans).max_m, 0.2);
}

TEST(DeadImuBefore, SoundUnitIsBelieved) {
  const RunResult run = RunOdometry(LongDrive(), test::DriveRig());
  EXPECT_FALSE(test::HasNotice(run, "lidar-only"));
  EXPECT_EQ(run.counters.num_restarts, 0);
}

}  // namespace
}  // namespace lio
