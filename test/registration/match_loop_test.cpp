// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/match_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace lio {
namespace {

class CountedReach {
 public:
  explicit CountedReach(int num_shrinks) : left_(num_shrinks) {}
  bool IsExhausted() const { return left_ == 0; }
  void Shrink() { left_ = std::max(0, left_ - 1); }

 private:
  int left_;
};

constexpr StopRule kRule{10, 1e-3, 1e-4};

Vector6 Forward(double metres) {
  return metres * Vector6::Unit(0);
}

TEST(MatchLoop, EndsWithASmallStepOnceTheRadiusIsZero) {
  Pose pose;
  MatchResult result;
  const auto step_at = [](const Pose&, const CountedReach&) -> std::optional<Vector6> {
    return Forward(5e-4);
  };
  EXPECT_TRUE(StepUntilStill(kRule, CountedReach(3), step_at, pose, result));
  EXPECT_EQ(result.status, MatchStatus::kConverged);
  EXPECT_EQ(result.iterations, 4);
  EXPECT_NEAR(pose.translation.x(), 4 * 5e-4, 1e-12);
}

TEST(MatchLoop, CountsNoMoreStepsThanItTook) {
  Pose pose;
  MatchResult result;
  const auto step_at = [](const Pose&, const CountedReach&) -> std::optional<Vector6> {
    return Forward(0.1);
  };
  EXPECT_TRUE(StepUntilStill(kRule, CountedReach(0), step_at, pose, result));
  EXPECT_EQ(result.status, MatchStatus::kMaxIterations);
  EXPECT_EQ(result.iterations, kRule.max_steps);
  EXPECT_NEAR(pose.translation.x(), 1.0, 1e-12);
}

TEST(MatchLoop, EndsWhereTooLittleIsMatched) {
  Pose pose;
  MatchResult result;
  const auto step_at = [](const Pose& at, const CountedReach&) -> std::optional<Vector6> {
    if (at.translation.x() > 0.15) return std::nullopt;
    return Forward(0.1);
  };
  EXPECT_TRUE(StepUntilStill(kRule, CountedReach(0), step_at, pose, result));
  EXPECT_EQ(result.status, MatchStatus::kMaxIterations);
  EXPECT_EQ(result.iterations, 3);
  EXPECT_NEAR(pose.translation.x(), 0.2, 1e-12);
}

TEST(MatchLoop, RefusesAStepThatIsNoNumber) {
  Pose pose;
  MatchResult result;
  const auto step_at = [](const Pose&, const CountedReach&) -> std::optional<Vector6> {
    return Forward(std::numeric_limits<double>::quiet_NaN());
  };
  EXPECT_FALSE(StepUntilStill(kRule, CountedReach(0), step_at, pose, result));
  EXPECT_EQ(result.status, MatchStatus::kDiverged);
  EXPECT_EQ(pose.translation, Vector3::Zero());
}

TEST(MatchLoop, ATurnKeepsItGoingAsAShiftDoes) {
  EXPECT_TRUE(kRule.IsSmall(5e-5 * Vector6::Unit(5)));
  EXPECT_FALSE(kRule.IsSmall(5e-4 * Vector6::Unit(5)));
  EXPECT_FALSE(kRule.IsSmall(Forward(2e-3)));
}

}  // namespace
}  // namespace lio
