// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/zero_velocity_detector.hpp"

#include <gtest/gtest.h>

#include "support/smooth_motion.hpp"

namespace lio {
namespace {

constexpr double kScan_s = 0.1;
constexpr double kRate_hz = 100.0;
constexpr int kEnough = 20;  // scans: two seconds

ImuRig Rig() {
  ImuRig rig;
  rig.gyro_noise_density = 5e-4;
  rig.accel_noise_density = 1e-3;
  return rig;
}

// Biases and tilt are known as after a second of rest.
Estimate KnownState() {
  Estimate estimate;
  estimate.cov.block<3, 3>(kRot, kRot) = 1e-8 * Matrix3::Identity();
  estimate.cov.block<3, 3>(kGyroBias, kGyroBias) = 2.5e-7 * Matrix3::Identity();
  estimate.cov.block<3, 3>(kAccelBias, kAccelBias) = 1e-6 * Matrix3::Identity();
  return estimate;
}

const Vector3 kGravityWorld(0, 0, -test::kGravity);

// Returns the k-th scan and the IMU samples of a moving body; the lidar may see another motion.
ZeroVelocityScan ScanOf(int k, const test::SmoothMotion& felt, const test::SmoothMotion& seen,
                        double scatter_m, std::mt19937_64& random) {
  const test::ImuErrors errors{Vector3::Zero(), Vector3::Zero(), Rig().gyro_noise_density,
                               Rig().accel_noise_density};
  const double middle_s = kScan_s * (k + 0.5);
  return {Timestamp{} + Duration::FromSeconds(middle_s),
          seen.At(middle_s).T_world_imu.translation + test::NormalVector(random, scatter_m),
          test::ReadImu(felt, kScan_s * k + 1e-3, kScan_s * (k + 1), kRate_hz, errors, random)};
}

bool HoldsAfter(int num_scans, const test::SmoothMotion& felt, const test::SmoothMotion& seen,
                double scatter_m = 1e-3) {
  std::mt19937_64 random(3);
  ZeroVelocityDetector standstill(Rig());
  for (int k = 0; k < num_scans; ++k) {
    standstill.Add(ScanOf(k, felt, seen, scatter_m, random));
  }
  return standstill.Judge(KnownState(), kGravityWorld);
}

bool HoldsAfter(int num_scans, const test::SmoothMotion& motion) {
  return HoldsAfter(num_scans, motion, motion);
}

TEST(ZeroVelocityDetector, RestIsSeenOnceTheWindowIsFull) {
  const test::SmoothMotion rest;
  EXPECT_FALSE(HoldsAfter(0, rest));
  EXPECT_FALSE(HoldsAfter(14, rest));
  EXPECT_TRUE(HoldsAfter(17, rest));
  EXPECT_TRUE(HoldsAfter(300, rest));
}

TEST(ZeroVelocityDetector, AnIdlingEngineIsRest) {
  test::SmoothMotion idle;
  idle.z.waves = {{1e-6, 160.0, 0.3}};     // 0.03 m/s^2 at 25 Hz
  idle.roll.waves = {{2e-5, 160.0, 1.0}};  // 0.003 rad/s
  EXPECT_TRUE(HoldsAfter(kEnough, idle));
}

TEST(ZeroVelocityDetector, ASlowCreepIsNoRest) {
  for (const double speed_mps : {0.02, 0.05, 0.5}) {
    test::SmoothMotion creep;
    creep.x.speed = speed_mps;
    EXPECT_FALSE(HoldsAfter(kEnough, creep)) << speed_mps;
  }
}

TEST(ZeroVelocityDetector, ASmoothRideIsNoRestHoweverCalm) {
  test::SmoothMotion cruise;
  cruise.x.speed = 28.0;
  EXPECT_FALSE(HoldsAfter(kEnough, cruise));
  test::SmoothMotion lift;
  lift.z.speed = 0.5;
  EXPECT_FALSE(HoldsAfter(kEnough, lift));
}

// The rings of a parked sensor, or the walls of a lift, hold the lidar in place.
TEST(ZeroVelocityDetector, WhatTheImuFeelsIsNoRestThoughTheLidarSeesNone) {
  const test::SmoothMotion rest;
  test::SmoothMotion drives_off;
  drives_off.x.accel = 0.1;
  EXPECT_FALSE(HoldsAfter(kEnough, drives_off, rest));
  test::SmoothMotion turns;
  turns.yaw.speed = 0.01;
  EXPECT_FALSE(HoldsAfter(kEnough, turns, rest));
  test::SmoothMotion shakes;
  shakes.z.waves = {{4e-4, 30.0, 0.0}};  // 0.36 m/s^2: a road
  EXPECT_FALSE(HoldsAfter(kEnough, shakes, rest));
}

// The poses scatter like those of a lidar with few rings.
TEST(ZeroVelocityDetector, MatchesThatScatterAreRest) {
  const test::SmoothMotion rest;
  EXPECT_TRUE(HoldsAfter(kEnough, rest, rest, 7e-3));
  EXPECT_FALSE(HoldsAfter(kEnough, rest, rest, 0.05));
}

TEST(ZeroVelocityDetector, AfterAStartAtRestItIsSeenAtOnceUntilItDrivesOff) {
  test::SmoothMotion drives_off;
  drives_off.x.accel = 0.3;
  for (const bool moves : {false, true}) {
    std::mt19937_64 random(5);
    ZeroVelocityDetector standstill(Rig());
    standstill.BeginAtRest();
    const test::SmoothMotion motion = moves ? drives_off : test::SmoothMotion();
    for (int k = 0; k < 10; ++k) {
      standstill.Add(ScanOf(k, motion, motion, 3e-3, random));
      EXPECT_EQ(standstill.Judge(KnownState(), kGravityWorld), !moves) << k;
    }
  }
}

TEST(ZeroVelocityDetector, AScanNowAndThenMayBeMissing) {
  const test::SmoothMotion rest;
  for (const bool lasts : {false, true}) {
    std::mt19937_64 random(5);
    ZeroVelocityDetector standstill(Rig());
    const auto is_missing = [&](int k) { return lasts ? k >= 8 && k < 14 : k % 3 == 1; };
    for (int k = 0; k < kEnough; ++k) {
      if (!is_missing(k)) standstill.Add(ScanOf(k, rest, rest, 1e-3, random));
    }
    EXPECT_EQ(standstill.Judge(KnownState(), kGravityWorld), !lasts);
  }
}

TEST(ZeroVelocityDetector, ForgettingBeginsTheWindowAnew) {
  ZeroVelocityDetector standstill(Rig());
  const auto add = [&](double t_s) {
    ImuSample sample;
    sample.f_imu_mps2 = -kGravityWorld;
    std::vector<ImuSample> samples;
    for (int i = 0; i < 10; ++i) {
      sample.stamp = Timestamp{} + Duration::FromSeconds(t_s + 0.01 * i);
      samples.push_back(sample);
    }
    standstill.Add({Timestamp{} + Duration::FromSeconds(t_s + 0.05), Vector3::Zero(), samples});
  };
  for (int k = 0; k < kEnough; ++k) add(kScan_s * k);
  EXPECT_TRUE(standstill.Judge(KnownState(), kGravityWorld));
  standstill.Forget();
  add(kScan_s * kEnough);
  EXPECT_FALSE(standstill.Judge(KnownState(), kGravityWorld));
}

}  // namespace
}  // namespace lio
