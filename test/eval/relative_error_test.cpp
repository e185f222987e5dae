// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/relative_error.hpp"

#include <gtest/gtest.h>

#include "eval/paths.hpp"

namespace lio {
namespace {

// The path is straight, and the estimate is 1 % too long.
Association OnePercentTooLong(int count, double step_m) {
  return Associate(test::Straight(count, step_m), test::Straight(count, 1.01 * step_m));
}

TEST(StepErrors, OfAConstantVelocityErrorAreConstant) {
  const StepErrors step = ComputeStepErrors(OnePercentTooLong(100, 1.0));
  EXPECT_EQ(step.errors.translation_m.count, 99);
  EXPECT_NEAR(step.errors.translation_m.median, 0.01, 1e-9);
  EXPECT_NEAR(step.errors.translation_m.max, 0.01, 1e-9);
  EXPECT_NEAR(step.interval_s, 0.1, 1e-12);
}

TEST(StepErrors, StepsAcrossAHoleAreLeftOut) {
  Trajectory estimate = test::Straight(100, 1.01);
  estimate.poses.erase(estimate.poses.begin() + 50, estimate.poses.begin() + 55);
  const StepErrors step = ComputeStepErrors(Associate(test::Straight(100, 1.0), estimate));
  EXPECT_EQ(step.errors.translation_m.count, 93);
  EXPECT_NEAR(step.errors.translation_m.max, 0.01, 1e-9);
}

TEST(StepErrors, RotationIsInDegrees) {
  const Trajectory truth = test::MakeTrajectory(50, [](int i) {
    return Pose{ExpSo3({0, 0, 0.1 * i}), Vector3::Zero()};
  });
  const Trajectory estimate = test::MakeTrajectory(50, [](int i) {
    return Pose{ExpSo3({0, 0, 0.1 * i + 0.5 * test::kDeg * i}), Vector3::Zero()};
  });
  const StepErrors step = ComputeStepErrors(Associate(truth, estimate));
  EXPECT_NEAR(step.errors.rotation_deg.median, 0.5, 1e-9);
}

TEST(RpeOverTime, AVelocityErrorTimesTheInterval) {
  // At 10 m/s an error of 1 % is 0.1 m in a second.
  const auto rpe = ComputeRpeOverTime(OnePercentTooLong(100, 1.0), 1.0);
  ASSERT_TRUE(rpe.has_value());
  EXPECT_EQ(rpe->translation_m.count, 90);
  EXPECT_NEAR(rpe->translation_m.rmse, 0.1, 1e-9);
}

TEST(RpeOverTime, ShortOrUnstampedRecordingsHaveNone) {
  EXPECT_FALSE(ComputeRpeOverTime(OnePercentTooLong(8, 1.0), 1.0).has_value());
  const Trajectory kitti = test::AsKitti(test::Straight(100, 1));
  EXPECT_FALSE(ComputeRpeOverTime(Associate(kitti, kitti), 1.0).has_value());
}

TEST(RpeOverDistance, EndsAtTheFirstPoseBeyondTheLength) {
  // The poses are a metre apart, so the first beyond 10 m is 11 m away.
  const PosePairs pairs = OnePercentTooLong(100, 1.0).pairs;
  const auto rpe = ComputeRpeOverDistance(pairs, 10);
  ASSERT_TRUE(rpe.has_value());
  EXPECT_EQ(rpe->translation_m.count, 89);
  EXPECT_NEAR(rpe->translation_m.mean, 0.11, 1e-9);
  EXPECT_FALSE(ComputeRpeOverDistance(pairs, 99).has_value());
}

// The expected value is computed by hand: there are 1001 poses a metre apart, and segments start at
// every tenth. A segment of L ends L + 1 m after its start, so starts 0 .. 999 - L serve: 90, 80,
// .. 20 segments for 100, 200, .. 800 m. A 1 % error over L + 1 m is (L + 1) / L per cent, and (90
// + .9 + 80 + .4 + 70 + .2333 + 60 + .15 + 50 + .1 + 40 + .0667 + 30 + .0429 + 20 + .025) / 440 =
// 441.917857 / 440 = 1.0043588 %.
TEST(Drift, EqualsAHandComputedKittiFigure) {
  for (const bool is_kitti_file : {false, true}) {
    Trajectory truth = test::Straight(1001, 1.0), estimate = test::Straight(1001, 1.01);
    if (is_kitti_file) truth = test::AsKitti(truth), estimate = test::AsKitti(estimate);
    const Drift drift = ComputeDrift(Associate(truth, estimate));
    EXPECT_TRUE(drift.is_kitti_lengths);
    EXPECT_EQ(drift.num_segments, 440);
    ASSERT_EQ(drift.by_length.size(), 8u);
    EXPECT_EQ(drift.by_length[0].num_segments, 90);
    EXPECT_NEAR(drift.by_length[0].translation_percent, 1.01, 1e-9);
    EXPECT_NEAR(drift.by_length[7].translation_percent, 801.0 / 800, 1e-9);
    EXPECT_NEAR(drift.translation_percent, 441.9178571428571 / 440, 1e-9);
    EXPECT_NEAR(drift.rotation_deg_per_100m, 0, 1e-9);
  }
}

// The path is the same, with an attitude that turns by 0.02 deg per metre: the result is 2 deg/100m
// times the same sum.
TEST(Drift, RotationIsPerHundredMetres) {
  const Trajectory estimate = test::MakeTrajectory(1001, [](int i) {
    return Pose{ExpSo3({0, 0, 0.02 * test::kDeg * i}), {1.0 * i, 0, 0}};
  });
  const Drift drift = ComputeDrift(Associate(test::Straight(1001, 1.0), estimate));
  EXPECT_NEAR(drift.rotation_deg_per_100m, 2 * 441.9178571428571 / 440, 1e-9);
}

TEST(Drift, ShortPathsUseShorterLengthsAndSaySo) {
  const Drift tens = ComputeDrift(OnePercentTooLong(311, 0.1));  // 31 m
  EXPECT_FALSE(tens.is_kitti_lengths);
  ASSERT_EQ(tens.by_length.size(), 3u);
  EXPECT_EQ(tens.by_length[2].length_m, 30);
  EXPECT_NEAR(tens.translation_percent, 1.0, 0.02);
  const Drift ones = ComputeDrift(OnePercentTooLong(51, 0.1));  // 5 m
  ASSERT_FALSE(ones.by_length.empty());
  EXPECT_EQ(ones.by_length[0].length_m, 1);
  EXPECT_EQ(ComputeDrift(OnePercentTooLong(20, 0.0)).num_segments, 0);
}

TEST(Drift, StartsLieASecondApartWhateverTheRate) {
  // The truth moves at 1 m/s at 10 Hz for 120 s: segments start at 0, 1, .. s; one of 100 m ends
  // after 100 s.
  const Drift drift = ComputeDrift(OnePercentTooLong(1201, 0.1));
  ASSERT_EQ(drift.by_length.size(), 1u);
  EXPECT_EQ(drift.by_length[0].num_segments, 20);
}

}  // namespace
}  // namespace lio
