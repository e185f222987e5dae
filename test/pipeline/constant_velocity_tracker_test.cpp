// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/constant_velocity_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

TrackerOptions WithGyro(const Vector3& rate_radps) {
  TrackerOptions options;
  options.first_rate_radps = rate_radps;
  return options;
}

ImuSample Reading(double t_s, const Vector3& rate_radps, const Vector3& force_mps2 = {0, 0, 0}) {
  ImuSample sample;
  sample.stamp = StampAt(t_s);
  sample.w_imu_radps = rate_radps;
  sample.f_imu_mps2 = force_mps2;
  return sample;
}

double StdOf(const Estimate& estimate, int at) {
  return std::sqrt(estimate.cov(at, at));
}

TEST(ConstantVelocityTracker, BeginsAtTheOriginAtRestAndUnsureOfIt) {
  const ConstantVelocityTracker tracker(StampAt(1.0), {});
  const Estimate& head = tracker.history().head();
  EXPECT_EQ(head.stamp, StampAt(1.0));
  EXPECT_EQ(head.state.T_map_imu.translation, Vector3(Vector3::Zero()));
  EXPECT_EQ(head.state.v_world_imu, Vector3(Vector3::Zero()));
  EXPECT_DOUBLE_EQ(StdOf(head, kVel), 15.0);
  EXPECT_DOUBLE_EQ(StdOf(head, kGyroBias), 1.0);
  EXPECT_EQ(StdOf(head, kMapPose), 0.0);
}

TEST(ConstantVelocityTracker, MayBeginElsewhereInTheWorldAndUnsureOfIt) {
  TrackerOptions options;
  options.seed.v_imu_mps = Vector3(20, 1, 0);
  options.T_world_start = {ExpSo3(Vector3(0, 0, M_PI / 2)), Vector3(5, 6, 7)};
  options.start_cov = 4.0 * Matrix6::Identity();
  const ConstantVelocityTracker tracker(StampAt(1.0), options);
  const Estimate& head = tracker.history().head();
  EXPECT_EQ(head.state.T_world_imu.translation, Vector3(5, 6, 7));
  EXPECT_EQ(head.state.T_map_imu.translation, Vector3(5, 6, 7));
  EXPECT_LT((head.state.v_world_imu - Vector3(-1, 20, 0)).norm(), 1e-9);
  EXPECT_DOUBLE_EQ(StdOf(head, kPos), 2.0);
  EXPECT_EQ(StdOf(head, kMapPose), 0.0);
}

TEST(ConstantVelocityTracker, AVelocitySeedIsWhereItBegins) {
  TrackerOptions options;
  options.seed.v_imu_mps = Vector3(20, 1, 0);
  const ConstantVelocityTracker tracker(StampAt(0.0), options);
  EXPECT_EQ(tracker.history().head().state.v_world_imu, Vector3(20, 1, 0));
  EXPECT_LT(StdOf(tracker.history().head(), kVel), 5.0);  // surer than of nothing, ...
  EXPECT_GT(StdOf(tracker.history().head(), kVel), 1.0);  // ... but it is only a seed
}

// An earlier tracker looked along y and drove that way, which is x of the new one.
TEST(ConstantVelocityTracker, AKnownMotionIsTakenIntoTheBodysAxes) {
  TrackerOptions options;
  options.seed.v_imu_mps = Vector3(99, 99, 99);  // must not count: the motion is known
  options.seed.motion.emplace();
  options.seed.motion->T_world_imu = {ExpSo3(Vector3(0, 0, M_PI / 2)), Vector3(50, 60, 0)};
  options.seed.motion->v_world_imu = {0, 5, 0};
  options.seed.motion->gyro_bias = {0, 0, -0.3};
  const ConstantVelocityTracker tracker(StampAt(0.0), options);
  const Estimate& head = tracker.history().head();
  EXPECT_LT((head.state.v_world_imu - Vector3(5, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(head.state.T_world_imu.translation, Vector3(Vector3::Zero()));
  EXPECT_EQ(head.state.gyro_bias, Vector3(0, 0, -0.3));
  EXPECT_DOUBLE_EQ(StdOf(head, kVel), 2.0);
  EXPECT_DOUBLE_EQ(StdOf(head, kGyroBias), 0.3);
}

// Velocity is a random walk of 1.5 m/s^2/sqrt(Hz): after 4 s 3 m/s more, in squares.
TEST(ConstantVelocityTracker, GoesStraightOnWithGrowingDoubt) {
  TrackerOptions options;
  options.seed.v_imu_mps = Vector3(10, 0, 0);
  ConstantVelocityTracker tracker(StampAt(0.0), options);
  const double std_at_first = StdOf(tracker.history().head(), kVel);
  tracker.AdvanceTo(StampAt(4.0));
  const Estimate& head = tracker.history().head();
  EXPECT_EQ(head.stamp, StampAt(4.0));
  EXPECT_LT((head.state.T_map_imu.translation - Vector3(40, 0, 0)).norm(), 1e-6);
  EXPECT_NEAR(StdOf(head, kVel), std::hypot(std_at_first, 3.0), 1e-6);
  tracker.AdvanceTo(StampAt(3.0));
  EXPECT_EQ(tracker.history().head().stamp, StampAt(4.0)) << "never backwards";
}

// The body goes at 5 m/s on a circle: matched poses teach velocity and turn rate.
TEST(ConstantVelocityTracker, WithoutAGyroPosesTeachTheTurnRate) {
  const auto circle = [](double t_s) {
    const double turned = 0.4 * t_s;
    return Pose{ExpSo3(Vector3(0, 0, turned)),
                12.5 * Vector3(std::sin(turned), 1.0 - std::cos(turned), 0)};
  };
  ConstantVelocityTracker tracker(StampAt(0.0), {});
  for (int i = 1; i <= 20; ++i) {
    tracker.AdvanceTo(StampAt(0.1 * i));
    PoseEvent event;
    event.measurement.T_map_imu = circle(0.1 * i);
    event.measurement.cov = 1e-4 * Matrix6::Identity();
    ASSERT_EQ(tracker.history().AddPose(StampAt(0.1 * i), event), EventOutcome::kApplied) << i;
  }
  const NavState& state = tracker.history().head().state;
  EXPECT_NEAR(-state.gyro_bias.z(), 0.4, 0.02);
  EXPECT_NEAR(state.v_world_imu.norm(), 5.0, 0.1);
  tracker.AdvanceTo(StampAt(2.1));
  const Pose off = circle(2.1).Inverse() * tracker.history().head().state.T_map_imu;
  EXPECT_LT(off.translation.norm(), 0.03);
}

// The velocity in the imu's axes is constant: 3 m/s forward and 2 rad/s to the left are a circle of
// 1.5 m, and a velocity that is constant in the world would miss it by 3 cm in a tenth of a second.
TEST(ConstantVelocityTracker, ATurningBodyGoesOnAlongItsCircle) {
  TrackerOptions options;
  options.follows_turns = true;
  options.seed.motion = NavState{};
  options.seed.motion->v_world_imu = Vector3(3, 0, 0);
  options.seed.motion->gyro_bias = Vector3(0, 0, -2);
  ConstantVelocityTracker tracker(StampAt(0.0), options);
  tracker.AdvanceTo(StampAt(0.1));
  const Pose expected{ExpSo3(Vector3(0, 0, 0.2)),
                      1.5 * Vector3(std::sin(0.2), 1 - std::cos(0.2), 0)};
  const Pose off = expected.Inverse() * tracker.history().head().state.T_map_imu;
  EXPECT_LT(off.translation.norm(), 1e-3);
  EXPECT_LT(LogSo3(off.rotation).norm(), 1e-6);
}

double TurnRateStdAfterASecond(double turn_error_rad) {
  TrackerOptions options;
  options.follows_turns = true;
  ConstantVelocityTracker tracker(StampAt(0.0), options);
  for (int i = 0; i < 500; ++i) tracker.NoteTurnError(turn_error_rad, 0.1);
  const double before = StdOf(tracker.history().head(), kGyroBias + 2);
  tracker.AdvanceTo(StampAt(1.0));
  return std::sqrt(std::pow(StdOf(tracker.history().head(), kGyroBias + 2), 2) - before * before);
}

// Its density is the one that the drive shows, between the bounds.
TEST(ConstantVelocityTracker, TheTurnRateWalksAsTheTurnsBeforeShow) {
  constexpr ConstantVelocityParameters kParameters = kConstantVelocity;
  EXPECT_NEAR(TurnRateStdAfterASecond(0.0), kParameters.min_turn_accel_density, 0.01);
  EXPECT_NEAR(TurnRateStdAfterASecond(0.3), kParameters.max_turn_accel_density, 0.04);
  const double between = 2.0 / kParameters.density_per_error * std::pow(0.1, 1.5);
  EXPECT_NEAR(TurnRateStdAfterASecond(between), 2.0, 0.02);
}

TEST(ConstantVelocityTracker, ASweepsEndIsByTheTurnRateThatItShows) {
  ConstantVelocityTracker tracker(StampAt(0.0), {});
  tracker.AdvanceTo(StampAt(0.1));
  PoseEvent event;
  event.measurement.cov = 1e-6 * Matrix6::Identity();
  ASSERT_EQ(tracker.history().AddPose(StampAt(0.05), event), EventOutcome::kApplied);
  const TurnRate shown{Vector3(0, 0, 0.4), 1e-6 * Matrix3::Identity()};
  const Estimate plain = tracker.AtEnd(StampAt(0.05), StampAt(0.1), {});
  const Estimate turned = tracker.AtEnd(StampAt(0.05), StampAt(0.1), shown);
  EXPECT_EQ(turned.stamp, StampAt(0.1));
  EXPECT_LT(LogSo3(plain.state.T_map_imu.rotation).norm(), 1e-9);
  EXPECT_NEAR(LogSo3(turned.state.T_map_imu.rotation).z(), 0.4 * 0.05, 1e-3);
  EXPECT_LT(StdOf(turned, kMapPose + 5), StdOf(plain, kMapPose + 5));
  // The filter itself goes on as before.
  EXPECT_EQ(tracker.history().head().state.gyro_bias, Vector3(Vector3::Zero()));
}

TEST(ConstantVelocityTracker, SaysWhetherItTookAMatch) {
  ConstantVelocityTracker tracker(StampAt(1.0), {});
  tracker.AdvanceTo(StampAt(1.1));
  MatchResult match;
  match.cov = 1e-4 * Matrix6::Identity();
  match.T_map_imu.translation.x() = 0.1;
  match.status = MatchStatus::kTooFewPoints;
  EXPECT_FALSE(tracker.AddMatch(StampAt(1.05), match));
  match.status = MatchStatus::kConverged;
  EXPECT_FALSE(tracker.AddMatch(StampAt(0.5), match));
  EXPECT_EQ(tracker.history().head().state.T_map_imu.translation.x(), 0.0);
  EXPECT_TRUE(tracker.AddMatch(StampAt(1.05), match));
  EXPECT_GT(tracker.history().head().state.T_map_imu.translation.x(), 0.05);
}

TEST(ConstantVelocityTracker, AGyroTurnsItAndForcesDoNotMoveIt) {
  ConstantVelocityTracker tracker(StampAt(0.0), WithGyro({0, 0, 0.2}));
  EXPECT_DOUBLE_EQ(StdOf(tracker.history().head(), kGyroBias), 0.02);
  // A rate that falls from 0.2 to 0 within half a second turns by 0.05.
  tracker.AddRate(Reading(0.5, {0, 0, 0}, {3, 2, 9.8}));
  const NavState& state = tracker.history().head().state;
  EXPECT_LT((LogSo3(state.T_map_imu.rotation) - Vector3(0, 0, 0.05)).norm(), 1e-9);
  EXPECT_EQ(state.T_map_imu.translation, Vector3(Vector3::Zero()));
  EXPECT_EQ(state.v_world_imu, Vector3(Vector3::Zero()));
}

// The gyro reads 0.1 rad/s too much, which was known before.
TEST(ConstantVelocityTracker, GoesOnByAGyroAlongTheCircleThatItReads) {
  Estimate before;
  before.stamp = StampAt(1.0);
  before.state.v_world_imu = {4, 0, 0};
  before.state.gyro_bias = {0, 0, 0.1};
  TrackerOptions options = WithGyro({0, 0, 0.1});
  options.follows_turns = true;
  options.goes_on_from = before;
  ConstantVelocityTracker tracker(StampAt(1.0), options);
  for (int i = 1; i <= 100; ++i) tracker.AddRate(Reading(1.0 + 0.01 * i, {0, 0, 0.5 + 0.1}));
  const NavState& state = tracker.history().head().state;
  EXPECT_LT(LogSo3(state.T_map_imu.rotation * ExpSo3(Vector3(0, 0, -0.5))).norm(), 0.01);
  EXPECT_LT((state.T_map_imu.rotation.conjugate() * state.v_world_imu - Vector3(4, 0, 0)).norm(),
            0.05);
  EXPECT_LT((tracker.w_imu_radps() - Vector3(0, 0, 0.5)).norm(), 1e-9);
  EXPECT_LT(StdOf(tracker.history().head(), kMapPose + 5), 0.1) << "the gyro tells the turn";
}

TEST(ConstantVelocityTracker, TheLastRateHolds) {
  ConstantVelocityTracker tracker(StampAt(0.0), WithGyro({0, 0, 0.3}));
  tracker.AddRate(Reading(0.1, {0, 0, 0.5}));
  tracker.AdvanceTo(StampAt(1.1));
  // 0.1 s at 0.4 in the mean, then 1 s at 0.5.
  EXPECT_LT(
      (LogSo3(tracker.history().head().state.T_map_imu.rotation) - Vector3(0, 0, 0.54)).norm(),
      1e-9);
}

TEST(ConstantVelocityTracker, ReadingsThatAreNotNewOrNotWantedAreLeftOut) {
  ConstantVelocityTracker tracker(StampAt(1.0), WithGyro({0, 0, 0}));
  tracker.AddRate(Reading(0.9, {0, 0, 5}));
  tracker.AddRate(Reading(1.0, {0, 0, 5}));
  tracker.AdvanceTo(StampAt(2.0));
  EXPECT_LT(LogSo3(tracker.history().head().state.T_map_imu.rotation).norm(), 1e-12);
  ConstantVelocityTracker without(StampAt(1.0), {});
  without.AddRate(Reading(1.5, {0, 0, 5}));
  EXPECT_EQ(without.history().head().stamp, StampAt(1.0));
}

TEST(ConstantVelocityTracker, ASetClockKeepsThePlaceAndDoubtsTheVelocity) {
  TrackerOptions options;
  options.seed.motion.emplace();
  options.seed.motion->v_world_imu = {10, 0, 0};
  ConstantVelocityTracker tracker(StampAt(100.0), options);
  tracker.AdvanceTo(StampAt(101.0));
  const Estimate before = tracker.history().head();
  tracker.SetClock(StampAt(3.0));
  const Estimate after = tracker.history().head();
  EXPECT_EQ(after.stamp, StampAt(3.0));
  EXPECT_EQ(after.state.T_map_imu.translation, before.state.T_map_imu.translation);
  EXPECT_EQ(after.state.v_world_imu, before.state.v_world_imu);
  EXPECT_NEAR(after.cov(kVel, kVel) - before.cov(kVel, kVel), 4.0, 1e-9);
  tracker.AdvanceTo(StampAt(4.0));
  EXPECT_NEAR(tracker.history().head().state.T_map_imu.translation.x(), 20.0, 1e-6);
}

// A clock that was set, from zero at the start of the machine to the present: no walk through it.
TEST(ConstantVelocityTracker, FarAheadItGoesOnWithoutFillingTheTime) {
  ConstantVelocityTracker tracker(StampAt(0.0), {});
  const Timestamp end = StampAt(1.7e9);
  tracker.AdvanceTo(end);
  EXPECT_EQ(tracker.history().head().stamp, end);
  EXPECT_LT(tracker.history().head().state.T_world_imu.translation.norm(), 1e-9);
}

}  // namespace
}  // namespace lio
