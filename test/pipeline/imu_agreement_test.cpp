// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "support/smooth_motion.hpp"

namespace lio {
namespace {

using test::CarMotion;
using test::NormalVector;
using test::SmoothMotion;
using test::StampFromZero;

using Spoil = std::function<void(ImuSample&)>;

constexpr double kPositionStd_m = 0.003;
constexpr double kRotationStd_rad = 5e-4;

// A hand that swings and turns.
SmoothMotion HandMotion() {
  SmoothMotion motion;
  motion.x = {0.0, 1.0, 0.0, {{0.1, 3.0, 0.0}}};
  motion.y = {0.0, 0.3, 0.0, {{0.1, 4.0, 1.0}}};
  motion.z = {1.0, 0.0, 0.0, {{0.04, 11.0, 0.5}}};
  motion.roll = {0.0, 0.0, 0.0, {{0.2, 3.0, 0.3}}};
  motion.pitch = {0.1, 0.0, 0.0, {{0.2, 2.5, 1.2}}};
  motion.yaw = {0.0, 0.2, 0.0, {{0.8, 1.5, 0.4}}};
  return motion;
}

// Scans at 10 Hz, each with its matched pose, and samples at 100 Hz.
struct Bench {
  explicit Bench(SmoothMotion path = CarMotion(), std::uint64_t seed = 1)
      : motion(std::move(path)), random(seed) {
    belief.g_map = Vector3(0, 0, -test::kGravity_mps2);
    belief.gyro_bias_std_radps = 0.002;
    belief.accel_bias_std_mps2 = 0.03;
    belief.noise.gyro_psd.setConstant(4e-8);
    belief.noise.accel_psd.setConstant(4e-6);
  }

  // `jump` is added to the matched position.
  std::optional<ImuContradiction> Scan(const Spoil& spoil = {},
                                       const Vector3& jump = Vector3::Zero()) {
    const double t_s = 0.1 * num_scans++;
    test::ImuErrors errors;
    errors.gyro_density = 2e-4;
    errors.accel_density = 2e-3;
    std::vector<ImuSample> samples =
        test::ReadImu(motion, t_s - 0.12, t_s + 0.02, 100.0, errors, random);
    if (spoil) std::ranges::for_each(samples, spoil);
    ImuAgreement::MatchedPose pose{.stamp = StampFromZero(t_s),
                                   .T_map_imu = motion.At(t_s).T_world_imu};
    pose.T_map_imu.translation += NormalVector(random, kPositionStd_m) + jump;
    pose.T_map_imu.rotation =
        pose.T_map_imu.rotation * ExpSo3(NormalVector(random, kRotationStd_rad));
    Vector6 variances;
    variances << Vector3::Constant(kPositionStd_m * kPositionStd_m),
        Vector3::Constant(kRotationStd_rad * kRotationStd_rad);
    pose.cov = variances.asDiagonal();
    agreement.Add(pose, samples, belief);
    return agreement.Find(belief);
  }
  // Returns the first contradiction in so many scans.
  std::optional<ImuContradiction> Scans(int num, const Spoil& spoil = {}) {
    for (int i = 0; i < num; ++i) {
      if (auto found = Scan(spoil)) return found;
    }
    return std::nullopt;
  }

  SmoothMotion motion;
  std::mt19937_64 random;
  ImuAgreement agreement;
  ImuAgreement::Belief belief;
  int num_scans = 0;
};

void StopGyro(ImuSample& sample) {
  sample.w_imu_radps.setZero();
}
void StopAccelerometer(ImuSample& sample) {
  sample.f_imu_mps2.setZero();
}
void ShiftForce(ImuSample& sample) {
  sample.f_imu_mps2.x() += 0.6;
}

TEST(ImuAgreement, SoundSamplesAreNeverContradicted) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    EXPECT_FALSE(Bench(CarMotion(), seed).Scans(300)) << seed;
    EXPECT_FALSE(Bench(HandMotion(), seed).Scans(300)) << seed;
  }
}

TEST(ImuAgreement, DeadGyroIsSeenWithinHalfASecondOfATurn) {
  Bench b(HandMotion());
  ASSERT_FALSE(b.Scans(50));
  const int broken_at = b.num_scans;
  const auto found = b.Scans(8, StopGyro);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sensor, ImuSensor::kGyro);
  EXPECT_LE(b.num_scans - broken_at, 5);
  EXPECT_GE(found->since, StampFromZero(0.1 * (broken_at - 2)));
  EXPECT_TRUE(found->evidence.starts_with("the gyro is ")) << found->evidence;
}

TEST(ImuAgreement, DeadAccelerometerIsSeenWithinHalfASecond) {
  Bench b;
  ASSERT_FALSE(b.Scans(50));
  const auto found = b.Scans(5, StopAccelerometer);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sensor, ImuSensor::kAccelerometer);
  EXPECT_GT(std::abs(found->axis_imu.z()), 0.95);  // gravity is what is missing
}

TEST(ImuAgreement, ForceThatIsALittleOffIsSeenOverALongerSpan) {
  Bench b;
  ASSERT_FALSE(b.Scans(50));
  const auto found = b.Scans(20, ShiftForce);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sensor, ImuSensor::kAccelerometer);
  EXPECT_GT(std::abs(found->axis_imu.x()), 0.9);
}

TEST(ImuAgreement, AMatchThatIsWrongContradictsNothing) {
  for (const double jump_m : {0.05, 0.3, 3.0}) {
    Bench b;
    ASSERT_FALSE(b.Scans(50));
    EXPECT_FALSE(b.Scan({}, Vector3(0, jump_m, 0))) << jump_m;
    EXPECT_FALSE(b.Scans(50)) << jump_m;
  }
}

// A narrow view can slide three times in a row.
TEST(ImuAgreement, ThreeDifferencesContradictWhereTheyAreLargeAndFourWhereNot) {
  std::vector<int> num_scans;
  for (const double off_radps : {0.03, 0.04, 0.045, 0.05, 0.055, 0.06, 0.1}) {
    Bench b;
    b.belief.clock_error_s = 0.0;
    ASSERT_FALSE(b.Scans(50));
    const int broken_at = b.num_scans;
    // The samples of a scan reach back to the one before.
    const auto turn = [&](ImuSample& sample) {
      if (sample.stamp > StampFromZero(0.1 * (broken_at - 1))) sample.w_imu_radps.z() += off_radps;
    };
    ASSERT_TRUE(b.Scans(20, turn)) << off_radps;
    num_scans.push_back(b.num_scans - broken_at);
  }
  EXPECT_TRUE(std::ranges::is_sorted(num_scans, std::greater<>()));
  EXPECT_GT(num_scans.front(), 3);
  EXPECT_TRUE(std::ranges::find(num_scans, 4) != num_scans.end());
  EXPECT_EQ(num_scans.back(), 3);
}

TEST(ImuAgreement, AJumpOfThePosesIsTold) {
  Bench b(HandMotion());
  for (int i = 0; i < 50; ++i) {
    ASSERT_FALSE(b.Scan());
    ASSERT_FALSE(b.agreement.HasJumped(b.belief));
  }
  ASSERT_FALSE(b.Scan({}, Vector3(0, 0.3, 0)));
  EXPECT_TRUE(b.agreement.HasJumped(b.belief));
}

TEST(ImuAgreement, AGyroThatIsOffAfterAJumpIsFoundByEightTurnsAndAForceIsNot) {
  Bench b;
  ASSERT_FALSE(b.Scans(50));
  const int broken_at = b.num_scans;
  const auto turn = [&](ImuSample& sample) {
    if (sample.stamp > StampFromZero(0.1 * (broken_at - 1))) sample.w_imu_radps.z() += 0.3;
  };
  const Vector3 jump(0.3, 0, 0);
  for (int i = 1; i < 8; ++i) {
    (void)b.Scan(turn, jump);
    EXPECT_FALSE(b.agreement.FindAfterJump(b.belief)) << i;
  }
  (void)b.Scan(turn, jump);
  const auto found = b.agreement.FindAfterJump(b.belief);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sensor, ImuSensor::kGyro);

  Bench force;
  ASSERT_FALSE(force.Scans(50));
  ASSERT_TRUE(force.Scans(50, ShiftForce));
  EXPECT_FALSE(force.agreement.FindAfterJump(force.belief));
}

TEST(ImuAgreement, MapThatIsLeftForAnotherPlaceContradictsNothing) {
  Bench b;
  ASSERT_FALSE(b.Scans(50));
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(b.Scan({}, Vector3(1, 2, 0)));
}

TEST(ImuAgreement, NothingIsSaidAlongADirectionThatMatchesDoNotSee) {
  Bench b;
  ASSERT_FALSE(b.Scans(50));
  b.agreement.Restart();
  for (int i = 0; i < 20; ++i) {
    const double t_s = 0.1 * b.num_scans++;
    std::vector<ImuSample> samples =
        test::ReadImu(b.motion, t_s - 0.12, t_s + 0.02, 100.0, {}, b.random);
    std::ranges::for_each(samples, StopAccelerometer);
    b.agreement.Add({StampFromZero(t_s), b.motion.At(t_s).T_world_imu, Matrix6::Identity()},
                    samples, b.belief);
    EXPECT_FALSE(b.agreement.Find(b.belief));
  }
}

TEST(ImuAgreement, WhatARigThatIsNotKnownMayBeOffByIsNoContradiction) {
  const auto turn = [](ImuSample& sample) {
    const Quaternion misaligned = ExpSo3(Vector3(0, 0, 0.1));
    sample.w_imu_radps = misaligned * sample.w_imu_radps;
    sample.f_imu_mps2 = misaligned * sample.f_imu_mps2;
  };
  EXPECT_FALSE(Bench(HandMotion()).Scans(300, turn));
  Bench known(HandMotion());
  known.belief.rig = RigBounds{};
  EXPECT_TRUE(known.Scans(300, turn));
}

TEST(ImuAgreement, WithoutGravityForcesTellNothing) {
  Bench b;
  b.belief.g_map.setZero();
  EXPECT_FALSE(b.Scans(100, StopAccelerometer));
}

TEST(ImuAgreement, BeginsAnewWhereSamplesAreMissing) {
  Bench b;
  ASSERT_FALSE(b.Scans(50));
  b.agreement.Add({StampFromZero(5.0), b.motion.At(5.0).T_world_imu}, {}, b.belief);
  EXPECT_EQ(b.agreement.last(), StampFromZero(5.0));
  EXPECT_FALSE(b.agreement.MotionNow());
}

TEST(ImuAgreement, MotionNowIsThatOfThePoses) {
  Bench b;
  ASSERT_FALSE(b.Scans(50));
  const auto motion = b.agreement.MotionNow();
  ASSERT_TRUE(motion);
  const test::MotionPoint truth = b.motion.At(4.8);
  const Vector3 v_imu = truth.T_world_imu.rotation.conjugate() * truth.v_world;
  EXPECT_LT((motion->v_imu_mps - v_imu).norm(), 0.4);
  EXPECT_LT((motion->w_imu_radps - truth.w_imu).norm(), 0.15);
}

// While it stands still a dead gyro is right.
TEST(ImuAgreement, MotionLikeTheOneThatWasNotFollowedMustBeShown) {
  Bench b(HandMotion());
  ASSERT_FALSE(b.Scans(50));
  const auto found = b.Scans(8, StopGyro);
  ASSERT_TRUE(found);
  Bench moving(HandMotion());
  Bench standing(SmoothMotion{});
  ASSERT_FALSE(moving.Scans(100));
  ASSERT_FALSE(standing.Scans(100));
  EXPECT_TRUE(moving.agreement.HasShownAlike(*found, StampFromZero(0.0)));
  EXPECT_FALSE(moving.agreement.HasShownAlike(*found, StampFromZero(9.8)));
  EXPECT_FALSE(standing.agreement.HasShownAlike(*found, StampFromZero(0.0)));
}

}  // namespace
}  // namespace lio
