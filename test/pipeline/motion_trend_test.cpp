// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/motion_trend.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

Vector6 Turn(double yaw_rad) {
  Vector6 turn = Vector6::Zero();
  turn[5] = yaw_rad;
  return turn;
}

TEST(MotionTrend, ExpectsNothingBeforeAScanAndAfterOneThatIsLost) {
  MotionTrend trend;
  EXPECT_EQ(trend.Expected(), Vector6(Vector6::Zero()));
  trend.Add(Pose::Identity(), ExpSe3(Turn(0.2)));
  EXPECT_GT(trend.Expected().norm(), 0.1);
  trend.Forget();
  EXPECT_EQ(trend.Expected(), Vector6(Vector6::Zero()));
}

TEST(MotionTrend, ALargeErrorComesAgain) {
  MotionTrend trend;
  const Pose predicted = ExpSe3((Vector6() << 3, 2, 1, 0.3, -0.2, 0.9).finished());
  trend.Add(predicted, predicted * ExpSe3(Turn(0.2)));
  EXPECT_NEAR(trend.Expected()[5], kMotionTrend.repeated_share * 0.2, 0.003);
  EXPECT_NEAR(trend.error()[5], 0.2, 1e-9);
}

// A prior that is off by what matching itself errs by says nothing of an acceleration.
TEST(MotionTrend, ASmallErrorIsNoise) {
  MotionTrend trend;
  trend.Add(Pose::Identity(), ExpSe3(Turn(0.002)));
  EXPECT_LT(std::abs(trend.Expected()[5]), 0.02 * 0.002);
}

}  // namespace
}  // namespace lio
