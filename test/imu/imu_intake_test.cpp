// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/imu_intake.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

constexpr double kStep_s = 0.01;

ImuSample Still(double t_s) {
  ImuSample sample;
  sample.stamp = StampAt(t_s);
  sample.f_imu_mps2 = -test::kGravity;
  return sample;
}

// Takes samples from `from_s` on; gives how many were accepted.
int Feed(ImuIntake& intake, double from_s, int num, bool* jumped = nullptr) {
  int num_accepted = 0;
  for (int i = 0; i < num; ++i) {
    const ImuIntake::Result result = intake.Add(Still(from_s + i * kStep_s));
    num_accepted += static_cast<int>(result.accepted.size());
    if (jumped != nullptr) *jumped = *jumped || result.jumped;
  }
  return num_accepted;
}

TEST(ImuIntake, OrdinarySamplesPassAtOnce) {
  Counters counters;
  ImuIntake intake(counters);
  bool jumped = false;
  EXPECT_EQ(Feed(intake, 0.0, 100, &jumped), 100);
  EXPECT_FALSE(jumped);
  EXPECT_EQ(counters.num_imu, 100);
  EXPECT_EQ(counters.num_imu_gaps, 0);
}

TEST(ImuIntake, NonFiniteSamplesAreDroppedAndCounted) {
  Counters counters;
  ImuIntake intake(counters);
  Feed(intake, 0.0, 5);
  ImuSample bad = Still(0.05);
  bad.w_imu_radps.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(intake.Add(bad).accepted.empty());
  bad = Still(0.05);
  bad.f_imu_mps2.z() = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(intake.Add(bad).accepted.empty());
  EXPECT_EQ(counters.num_imu_nonfinite, 2);
  EXPECT_EQ(counters.num_imu, 7);
}

TEST(ImuIntake, ReadingsBeyondAnySensorAreDroppedAndCounted) {
  Counters counters;
  ImuIntake intake(counters);
  ImuSample bad = Still(0.0);
  bad.w_imu_radps.x() = 1e3;
  EXPECT_TRUE(intake.Add(bad).accepted.empty());
  bad = Still(0.0);
  bad.f_imu_mps2.x() = 1e6;
  EXPECT_TRUE(intake.Add(bad).accepted.empty());
  EXPECT_EQ(counters.num_imu_out_of_range, 2);
}

TEST(ImuIntake, DroppedSampleDoesNotMoveTheClock) {
  Counters counters;
  ImuIntake intake(counters);
  ImuSample bad = Still(500.0);
  bad.w_imu_radps.x() = std::numeric_limits<double>::quiet_NaN();
  intake.Add(bad);
  EXPECT_EQ(Feed(intake, 0.0, 3), 3);
  EXPECT_EQ(counters.num_clock_jumps, 0);
}

TEST(ImuIntake, OutOfOrderSamplesPass) {
  Counters counters;
  ImuIntake intake(counters);
  Feed(intake, 0.0, 10);
  const ImuIntake::Result late = intake.Add(Still(0.035));
  ASSERT_EQ(late.accepted.size(), 1u);
  EXPECT_FALSE(late.jumped);
  EXPECT_EQ(counters.num_imu_gaps, 0);
}

TEST(ImuIntake, ShortGapIsCountedAndNoJump) {
  Counters counters;
  ImuIntake intake(counters);
  bool jumped = false;
  Feed(intake, 0.0, 10);
  EXPECT_EQ(Feed(intake, 0.69, 10, &jumped), 10);
  EXPECT_FALSE(jumped);
  EXPECT_EQ(counters.num_imu_gaps, 1);
}

TEST(ImuIntake, OneWrongStampIsDroppedAndTheStreamGoesOn) {
  for (const double wrong_s : {-1000.0, 1000.0}) {
    Counters counters;
    ImuIntake intake(counters);
    bool jumped = false;
    Feed(intake, 0.0, 10);
    EXPECT_TRUE(intake.Add(Still(wrong_s)).accepted.empty());
    EXPECT_EQ(Feed(intake, 0.1, 10, &jumped), 10);
    EXPECT_FALSE(jumped);
    EXPECT_EQ(counters.num_imu_out_of_range, 1) << wrong_s;
    EXPECT_EQ(counters.num_clock_jumps + counters.num_imu_gaps, 0) << wrong_s;
  }
}

TEST(ImuIntake, LongGapBeginsANewStretchOnceConfirmedAndLosesNoSample) {
  Counters counters;
  ImuIntake intake(counters);
  bool jumped = false;
  Feed(intake, 0.0, 10);
  EXPECT_EQ(Feed(intake, 5.0, 20, &jumped), 20);
  EXPECT_TRUE(jumped);
  EXPECT_EQ(counters.num_imu_gaps, 1);
  EXPECT_EQ(counters.num_clock_jumps, 0);
}

TEST(ImuIntake, ClockSetBackBeginsANewStretchAndIsCounted) {
  Counters counters;
  ImuIntake intake(counters);
  bool jumped = false;
  Feed(intake, 100.0, 10);
  EXPECT_EQ(Feed(intake, 0.0, 20, &jumped), 20);
  EXPECT_TRUE(jumped);
  EXPECT_EQ(counters.num_clock_jumps, 1);
}

TEST(ImuIntake, WildStampsNeverBecomeAStretch) {
  Counters counters;
  ImuIntake intake(counters);
  Feed(intake, 0.0, 10);
  for (int i = 1; i <= 20; ++i) {
    EXPECT_TRUE(intake.Add(Still(i % 2 == 0 ? 100.0 * i : -100.0 * i)).accepted.empty());
  }
  EXPECT_EQ(Feed(intake, 0.1, 5), 5);
  EXPECT_EQ(counters.num_imu_out_of_range, 20);
  EXPECT_EQ(counters.num_clock_jumps, 0);
}

}  // namespace
}  // namespace lio
