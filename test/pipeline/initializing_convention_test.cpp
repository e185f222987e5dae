// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which units, axes and gravity a start finds in the inertial messages.
#include <gtest/gtest.h>

#include "lio/base/angle.hpp"
#include "pipeline/initializing.hpp"
#include "pipeline/initializing_bench.hpp"

namespace lio {
namespace {

using test::InitializingBench;
using test::kDriveFrom_s;
using test::kStandardGravity_mps2;
using test::Leaning;
using test::Motion;

Options OptionsIn(ImuUnits units) {
  Options options;
  options.rig.imu.units = units;
  return options;
}

TEST(InitializingConvention, ForcesInGAtRestChangeTheConventionAndBeginAgain) {
  InitializingBench b;
  b.bench.force_scale = 1.0 / kStandardGravity_mps2;
  const auto transition = b.Drive(Leaning(), 0.0, 2.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kRetry);
  EXPECT_TRUE(b.bench.stream().imu().convention().is_in_g);
  EXPECT_FALSE(b.bench.stream().imu().convention().is_in_deg);
  EXPECT_NEAR(b.bench.stream().imu().samples().back().f_imu_mps2.norm(), kStandardGravity_mps2,
              1e-6);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
}

TEST(InitializingConvention, ErrorsLearnedInOtherAxesAreForgotten) {
  InitializingBench b;
  MatchResult match;
  match.beam_pull.scores = {Vector6::Ones()};
  match.shift_per_score = Matrix6::Identity();
  match.new_content_share = 1.0;
  b.bench.sensor_errors().Add(match);
  ASSERT_FALSE(b.bench.sensor_errors().CovPerReplacement(match).isZero(0.0));
  b.bench.force_scale = 1.0 / kStandardGravity_mps2;
  ASSERT_TRUE(b.Drive(Leaning(), 0.0, 2.0));
  EXPECT_TRUE(b.bench.sensor_errors().CovPerReplacement(match).isZero(0.0));
}

TEST(InitializingConvention, SecondTryWithTheSamplesInGStarts) {
  InitializingBench b;
  b.bench.force_scale = 1.0 / kStandardGravity_mps2;
  auto retry = b.Drive(Leaning(), 0.0, 2.0);
  ASSERT_TRUE(retry);
  b.BeginAgain(*retry);
  const auto transition = b.MatchWaiting(Leaning());
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kStarted);
}

TEST(InitializingConvention, RatesInDegreesOfADriveChangeTheConvention) {
  InitializingBench b;
  b.bench.rate_scale = kDegPerRad;
  const Motion drive = test::WindingDrive(0.0);
  double from_s = kDriveFrom_s;
  while (!b.bench.stream().imu().convention().is_in_deg && from_s < kDriveFrom_s + 10.0) {
    const auto transition = b.Drive(drive, from_s, from_s + 0.1);
    from_s += 0.1;
    if (!transition) continue;
    ASSERT_EQ(transition->trigger, Trigger::kRetry);
    b.BeginAgain(*transition);
  }
  EXPECT_TRUE(b.bench.stream().imu().convention().is_in_deg);
  EXPECT_FALSE(b.bench.stream().imu().convention().is_in_g);
}

TEST(InitializingConvention, ForcesInGContradictConfiguredSiUnits) {
  InitializingBench b(OptionsIn(ImuUnits::kSi));
  b.bench.force_scale = 1.0 / kStandardGravity_mps2;
  const auto transition = b.Drive(Leaning(), 0.0, 2.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kContradicted);
  EXPECT_FALSE(b.bench.stream().imu().convention().is_in_g);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kError));
}

TEST(InitializingConvention, GravityInTheForcesContradictsARigWithoutIt) {
  Options options;
  options.rig.imu.gravity = GravityInput::kRemoved;
  InitializingBench b(options);
  const auto transition = b.Drive(Leaning(), 0.0, 2.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kContradicted);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kError));
}

TEST(InitializingConvention, ForceOfNoUnitIsWaitedOut) {
  InitializingBench b;
  b.bench.force_scale = 0.5;
  EXPECT_FALSE(b.Drive(Leaning(), 0.0, 2.0));
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kInfo));
}

// Returns the last fix after forces in g have been told as such at rest.
LastFix FixAfterForcesInG(const Handover& handover) {
  InitializingBench b({}, handover);
  b.bench.force_scale = 1.0 / kStandardGravity_mps2;
  const auto transition = b.Drive(Leaning(), 0.0, 2.0);
  EXPECT_TRUE(transition && transition->trigger == Trigger::kRetry);
  return transition ? transition->handover.last_fix : LastFix{};
}

TEST(InitializingConvention, OtherConventionGivesTheLastFixTheShapeOfThePathInTheMap) {
  Handover handover;
  handover.origin = Handover::Origin::kInertial;
  handover.last_fix.T_world_imu.translation = Vector3(9, 0, 3);  // bent by a wrong gravity
  handover.last_fix.T_map_imu.translation = Vector3(10, 0, 0);
  handover.T_world_start.translation = Vector3(0, 0, 1);
  const LastFix fix = FixAfterForcesInG(handover);
  EXPECT_NEAR((fix.T_world_imu.translation - Vector3(10, 0, 1)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((fix.T_map_imu.translation - Vector3(10, 0, 0)).norm(), 0.0, 1e-9);
}

// Somebody said where the body is, and nothing has been published since with wrong axes.
TEST(InitializingConvention, OtherConventionLeavesAGivenPoseAsItIs) {
  Handover handover;
  handover.origin = Handover::Origin::kInertial;
  handover.is_placed = true;
  handover.last_fix.T_world_imu = {ExpSo3(Vector3(0, 0, 1)), Vector3(100, -20, 3)};
  handover.last_fix.T_map_imu = handover.last_fix.T_world_imu;
  handover.T_world_start.translation = Vector3(0, 0, 1);  // nothing is to be led back to it
  const LastFix fix = FixAfterForcesInG(handover);
  const Pose& given = handover.last_fix.T_world_imu;
  EXPECT_NEAR((fix.T_world_imu.translation - given.translation).norm(), 0.0, 1e-9);
  EXPECT_NEAR(LogSo3(fix.T_world_imu.rotation).z(), 1.0, 1e-9);
  EXPECT_NEAR((fix.T_map_imu.translation - given.translation).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace lio
