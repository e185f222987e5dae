// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/segment_jump.hpp"

#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;
using Step = ImuPreprocessor::Step;

SegmentJump JumpTo(double first_s, Step step) {
  SegmentStarts segment;
  segment.first.stamp = StampAt(first_s);
  segment.step = step;
  return JudgeJump(StampAt(10.0), segment);
}

// The body goes ten metres a second along y, and is sure of all of it.
Estimate SlidingAlongY() {
  Estimate estimate;
  estimate.stamp = StampAt(10.0);
  estimate.state.T_world_imu.translation = Vector3(3, 4, 5);
  estimate.state.v_world_imu = Vector3(0, 10, 0);
  estimate.state.gyro_bias = Vector3(0.01, -0.02, 0.03);
  estimate.cov.diagonal().setConstant(1e-6);
  return estimate;
}

double PositionVariance(const Estimate& estimate) {
  return estimate.cov.block<3, 3>(kPos, kPos).trace();
}

TEST(JudgeJump, SamplesThatAreMissingAreAGapUpToThreeSeconds) {
  const SegmentJump gap = JumpTo(12.9, Step::kGap);
  EXPECT_EQ(gap.kind, SegmentJump::Kind::kGap);
  EXPECT_NEAR(gap.jump_s, 2.9, 1e-9);
  EXPECT_NEAR(gap.unknown_s, 2.9, 1e-9);
  EXPECT_EQ(gap.set_by(), Duration{});
  EXPECT_EQ(JumpTo(13.0, Step::kGap).kind, SegmentJump::Kind::kUnseen);
}

TEST(JudgeJump, AClockThatGoesBackWasSetUnlessBySeconds) {
  for (const Step step : {Step::kSetBack, Step::kGap}) {
    const SegmentJump jump = JumpTo(7.1, step);
    EXPECT_EQ(jump.kind, SegmentJump::Kind::kClockSet);
    EXPECT_EQ(jump.unknown_s, kSegmentJump.clock_set_s);
    EXPECT_NEAR(jump.set_by().Seconds(), -2.9 - kSegmentJump.clock_set_s, 1e-9);
    EXPECT_EQ(JumpTo(7.0, step).kind, SegmentJump::Kind::kSetFarBack);
  }
}

TEST(JudgeJump, AClockThatIsSetRightHidesAMomentHoweverFarItGoes) {
  const SegmentJump jump = JumpTo(110.0, Step::kSetRight);
  EXPECT_EQ(jump.kind, SegmentJump::Kind::kClockSet);
  EXPECT_EQ(jump.unknown_s, kSegmentJump.clock_set_s);
  EXPECT_NEAR(jump.set_by().Seconds(), 100.0 - kSegmentJump.clock_set_s, 1e-9);
}

TEST(JudgeJump, OtherwiseTheTimeOfAStepForthMayHavePassedButNoMoreThanThreeSeconds) {
  EXPECT_NEAR(JumpTo(10.7, Step::kHole).unknown_s, 0.7, 1e-9);
  EXPECT_EQ(JumpTo(60.0, Step::kHole).unknown_s, kImuGap.unknown.Seconds());
}

TEST(CarriedOver, TheBodyGoesStraightOnInAGap) {
  const Estimate before = SlidingAlongY();
  const Estimate after =
      CarriedOver(before, JumpTo(12.0, Step::kGap), StampAt(12.0), HistoryOptions{});
  EXPECT_EQ(after.stamp, StampAt(12.0));
  EXPECT_LT((after.state.T_world_imu.translation - Vector3(3, 24, 5)).norm(), 1e-6);
  EXPECT_LT((after.state.v_world_imu - before.state.v_world_imu).norm(), 1e-6);
  EXPECT_LT(LogSo3(after.state.T_world_imu.rotation).norm(), 1e-9);
  EXPECT_GT(PositionVariance(after), 1.0);
}

TEST(CarriedOver, TheBodyStaysWhileAClockIsSetButForAMoment) {
  const Estimate before = SlidingAlongY();
  const Estimate after =
      CarriedOver(before, JumpTo(8.0, Step::kSetBack), StampAt(8.0), HistoryOptions{});
  EXPECT_EQ(after.stamp, StampAt(8.0));
  EXPECT_EQ(after.state.T_world_imu.translation, before.state.T_world_imu.translation);
  EXPECT_GT(PositionVariance(after), PositionVariance(before));
  EXPECT_LT(PositionVariance(after), 0.1);
}

}  // namespace
}  // namespace lio
