// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/zero_velocity_detector.hpp"

#include <gtest/gtest.h>

#include "support/smooth_motion.hpp"

namespace lio {
namespace {

constexpr double kScan_s = 0.1;
constexpr double kRate_hz = 100.0;
constexpr int kEnough = 20;  // scans: two seconds

ImuRig QuietImu() {
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

const Vector3 kGravityWorld(0, 0, -test::kGravity_mps2);

// Returns the k-th scan and the IMU samples of a moving body; the lidar may see another motion.
ZeroVelocityScan ScanOf(int k, const test::SmoothMotion& felt, const test::SmoothMotion& seen,
                        double scatter_m, std::mt19937_64& random) {
  const test::ImuErrors errors{Vector3::Zero(), Vector3::Zero(), QuietImu().gyro_noise_density,
                               QuietImu().accel_noise_density};
  const double middle_s = kScan_s * (k + 0.5);
  return {Timestamp{} + Duration::FromSeconds(middle_s),
          seen.At(middle_s).T_world_imu.translation + test::NormalVector(random, scatter_m),
          test::ReadImu(felt, kScan_s * k + 1e-3, kScan_s * (k + 1), kRate_hz, errors, random)};
}

bool HoldsAfter(int num_scans, const test::SmoothMotion& felt, const test::SmoothMotion& seen,
                double scatter_m = 1e-3) {
  std::mt19937_64 random(3);
  ZeroVelocityDetector standstill(QuietImu());
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
    ZeroVelocityDetector standstill(QuietImu());
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
    ZeroVelocityDetector standstill(QuietImu());
    const auto is_missing = [&](int k) { return lasts ? k >= 8 && k < 14 : k % 3 == 1; };
    for (int k = 0; k < kEnough; ++k) {
      if (!is_missing(k)) standstill.Add(ScanOf(k, rest, rest, 1e-3, random));
    }
    EXPECT_EQ(standstill.Judge(KnownState(), kGravityWorld), !lasts);
  }
}

TEST(ZeroVelocityDetector, ForgettingBeginsTheWindowAnew) {
  ZeroVelocityDetector standstill(QuietImu());
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

// Judges two seconds in which rate and force were the same all the time.
bool HoldsAt(const Estimate& estimate, const Vector3& w_imu_radps, const Vector3& f_imu_mps2) {
  ZeroVelocityDetector standstill(QuietImu());
  for (int k = 0; k < kEnough; ++k) {
    std::vector<ImuSample> samples;
    for (int i = 0; i < 10; ++i) {
      const Timestamp stamp = Timestamp{} + Duration::FromSeconds(kScan_s * k + 0.01 * i);
      samples.push_back({stamp, w_imu_radps, f_imu_mps2});
    }
    standstill.Add({samples[5].stamp, Vector3::Zero(), samples});
  }
  return standstill.Judge(estimate, kGravityWorld);
}

const Vector3 kNoRate = Vector3::Zero();
const Vector3 kUpForce = -kGravityWorld;

TEST(ZeroVelocityDetector, KnownGyroBiasIsNoTurn) {
  const Vector3 bias(0.01, -0.02, 0.03);
  Estimate estimate = KnownState();
  EXPECT_FALSE(HoldsAt(estimate, bias, kUpForce));
  estimate.state.gyro_bias = bias;
  EXPECT_TRUE(HoldsAt(estimate, bias, kUpForce));
  EXPECT_FALSE(HoldsAt(estimate, -bias, kUpForce));
}

TEST(ZeroVelocityDetector, TurnMayBeTheGyroBiasWhileThatIsUnknown) {
  Estimate estimate = KnownState();
  EXPECT_FALSE(HoldsAt(estimate, Vector3(0, 0, 0.02), kUpForce));
  estimate.cov(kGyroBias + 2, kGyroBias + 2) = 1e-4;
  EXPECT_TRUE(HoldsAt(estimate, Vector3(0, 0, 0.02), kUpForce));
  EXPECT_FALSE(HoldsAt(estimate, Vector3(0, 0.02, 0), kUpForce)) << "that axis is known";
}

TEST(ZeroVelocityDetector, KnownAccelerometerBiasIsNoAcceleration) {
  const Vector3 bias(0.1, -0.2, 0.3);
  Estimate estimate = KnownState();
  EXPECT_FALSE(HoldsAt(estimate, kNoRate, kUpForce + bias));
  estimate.state.accel_bias = bias;
  EXPECT_TRUE(HoldsAt(estimate, kNoRate, kUpForce + bias));
  EXPECT_FALSE(HoldsAt(estimate, kNoRate, kUpForce - bias));
}

TEST(ZeroVelocityDetector, AccelerationMayBeTheBiasWhileThatIsUnknown) {
  Estimate estimate = KnownState();
  EXPECT_FALSE(HoldsAt(estimate, kNoRate, kUpForce + Vector3(0, 0, 0.2)));
  estimate.cov(kAccelBias + 2, kAccelBias + 2) = 0.01;
  EXPECT_TRUE(HoldsAt(estimate, kNoRate, kUpForce + Vector3(0, 0, 0.2)));
  EXPECT_FALSE(HoldsAt(estimate, kNoRate, kUpForce + Vector3(0, 0.2, 0))) << "that axis is known";
}

TEST(ZeroVelocityDetector, GravityIsThatOfTheTiltedBody) {
  const Quaternion R_world_imu = ExpSo3(Vector3(0.1, -0.2, 1.0));
  const Vector3 f_imu_mps2 = R_world_imu.conjugate() * kUpForce;
  Estimate estimate = KnownState();
  EXPECT_FALSE(HoldsAt(estimate, kNoRate, f_imu_mps2));
  estimate.state.T_world_imu.rotation = R_world_imu;
  EXPECT_TRUE(HoldsAt(estimate, kNoRate, f_imu_mps2));
  EXPECT_FALSE(HoldsAt(estimate, kNoRate, R_world_imu * kUpForce));
}

// An error of 0.02 rad in roll turns 0.2 m/s^2 of gravity into the imu's y axis; one in yaw, none.
TEST(ZeroVelocityDetector, AccelerationMayBeGravityWhileTheTiltIsUnknown) {
  const Vector3 f_imu_mps2 = ExpSo3(Vector3(-0.02, 0, 0)) * kUpForce;
  const auto holds_with_unknown = [&](int axis) {
    Estimate estimate = KnownState();
    estimate.cov(kRot + axis, kRot + axis) = 4e-4;
    return HoldsAt(estimate, kNoRate, f_imu_mps2);
  };
  EXPECT_FALSE(HoldsAt(KnownState(), kNoRate, f_imu_mps2));
  EXPECT_TRUE(holds_with_unknown(0));
  EXPECT_FALSE(holds_with_unknown(1));
  EXPECT_FALSE(holds_with_unknown(2));
}

// After a start at rest the bias hides in the tilt: an error of either alone would show.
TEST(ZeroVelocityDetector, TiltAndBiasThatCancelExplainNoAcceleration) {
  constexpr double kTiltVar = 4e-4;
  const Vector3 f_imu_mps2 = kUpForce + Vector3(0, 0.2, 0);
  for (const double sign : {-1.0, 1.0}) {  // -1: f = -R^T g + bias stays the same
    Estimate estimate = KnownState();
    estimate.cov(kRot, kRot) += kTiltVar;
    estimate.cov(kAccelBias + 1, kAccelBias + 1) +=
        kTiltVar * test::kGravity_mps2 * test::kGravity_mps2;
    estimate.cov(kRot, kAccelBias + 1) = sign * kTiltVar * test::kGravity_mps2;
    estimate.cov(kAccelBias + 1, kRot) = sign * kTiltVar * test::kGravity_mps2;
    EXPECT_EQ(HoldsAt(estimate, kNoRate, f_imu_mps2), sign > 0) << sign;
  }
}

}  // namespace
}  // namespace lio
