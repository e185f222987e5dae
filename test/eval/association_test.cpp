// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/association.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/paths.hpp"

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Trajectory Shifted(Trajectory trajectory, std::int64_t ns) {
  for (StampedPose& row : trajectory.poses) row.stamp = row.stamp + Duration{ns};
  return trajectory;
}

TEST(Association, TruthIsInterpolatedAtTheEstimatesStamps) {
  const Trajectory truth = test::MakeTrajectory(10, [](int i) {
    return Pose{ExpSo3({0, 0, 0.2 * i}), {2.0 * i, 0, 0}};
  });
  const Association result = Associate(truth, Shifted(truth, 25'000'000));
  EXPECT_EQ(result.method, AssociationMethod::kTruthInterpolated);
  EXPECT_EQ(result.pairs.size(), 9u);
  EXPECT_EQ(result.num_outside, 1);
  EXPECT_NEAR(result.pairs[3].truth.translation.x(), 6.5, 1e-9);
  EXPECT_NEAR(LogSo3(result.pairs[3].truth.rotation).z(), 0.65, 1e-9);
  EXPECT_EQ(result.pairs[3].estimate.translation.x(), 6.0);
}

TEST(Association, GapsWiderThanTheLimitAreNotBridged) {
  Trajectory truth = test::Straight(50, 1);
  truth.poses.erase(truth.poses.begin() + 20, truth.poses.begin() + 30);  // a gap of 1.1 s
  const Trajectory estimate = Shifted(test::Straight(50, 1), 10'000'000);
  const Association strict = Associate(truth, estimate);
  EXPECT_DOUBLE_EQ(strict.max_gap_s, 0.25);
  EXPECT_TRUE(strict.is_max_gap_automatic);
  EXPECT_EQ(strict.num_in_gap, 11);
  EXPECT_EQ(strict.pairs.size(), 38u);
  const Association loose = Associate(truth, estimate, 1.2);
  EXPECT_EQ(loose.num_in_gap, 0);
  EXPECT_EQ(loose.pairs.size(), 49u);
  EXPECT_FALSE(loose.is_max_gap_automatic);
}

TEST(Association, SparseTruthMakesTheEstimateTheInterpolatedOne) {
  const Trajectory estimate = test::Straight(101, 1);
  Trajectory truth;
  for (int i = 5; i < 100; i += 10) truth.poses.push_back(estimate.poses[i]);
  for (StampedPose& row : truth.poses) row.stamp = row.stamp + Duration{50'000'000};
  const Association result = Associate(truth, estimate);
  EXPECT_EQ(result.method, AssociationMethod::kEstimateInterpolated);
  EXPECT_EQ(result.pairs.size(), 10u);
  EXPECT_NEAR(result.pairs[0].estimate.translation.x(), 5.5, 1e-9);
  EXPECT_EQ(result.pairs[0].truth.translation.x(), 5.0);
}

TEST(Association, MissingFramesAndCoverageAreCounted) {
  const Trajectory truth = test::Straight(101, 1);  // 10 s
  Trajectory estimate = truth;
  estimate.poses.erase(estimate.poses.begin() + 60, estimate.poses.begin() + 63);
  estimate.poses.erase(estimate.poses.begin(), estimate.poses.begin() + 20);
  const Association result = Associate(truth, estimate);
  EXPECT_EQ(result.num_missing_frames, 3);
  // The truth lasts 8 s after the first estimate, minus a hole of 0.4 s that counts as one period.
  EXPECT_NEAR(result.coverage_ratio, 0.77, 1e-9);
}

TEST(Association, KittiFilesPairRowByRow) {
  const Trajectory truth = test::AsKitti(test::Straight(30, 1));
  Trajectory estimate = truth;
  estimate.poses.resize(27);
  const Association result = Associate(truth, estimate);
  EXPECT_EQ(result.method, AssociationMethod::kByIndex);
  EXPECT_EQ(result.pairs.size(), 27u);
  EXPECT_EQ(result.num_missing_frames, 3);
  EXPECT_DOUBLE_EQ(result.coverage_ratio, 0.9);
}

TEST(Association, StampedAndUnstampedPairOnlyWithEqualRows) {
  const Trajectory tum = test::Straight(30, 1);
  EXPECT_EQ(Associate(test::AsKitti(tum), tum).pairs.size(), 30u);
  EXPECT_THAT([&] { (void)Associate(test::AsKitti(test::Straight(29, 1)), tum); },
              ThrowsMessage<std::runtime_error>(HasSubstr("29 rows and the estimate 30")));
}

TEST(Association, TooLittleInCommonIsRefusedWithBothSpans) {
  const Trajectory truth = test::Straight(10, 1);
  const auto associate = [&] { (void)Associate(truth, Shifted(truth, 3600'000'000'000)); };
  EXPECT_THAT(associate,
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("truth covers 1000.000000000 .. 1000.900000000 s"),
                        HasSubstr("estimate 4600.000000000"), HasSubstr("check their clocks"))));
  EXPECT_THROW((void)Associate(test::Straight(1, 1), truth), std::runtime_error);
  EXPECT_THROW((void)Associate(test::AsKitti(test::Straight(2, 1)), test::AsKitti(truth)),
               std::runtime_error);
}

}  // namespace
}  // namespace lio
