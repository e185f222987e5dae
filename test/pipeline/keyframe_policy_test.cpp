// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/keyframe_policy.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

Pose At(double x_m, double yaw_rad = 0.0) {
  return {ExpSo3(Vector3(0, 0, yaw_rad)), Vector3(x_m, 0, 0)};
}

// Returns how many of `num` scans at one place are inserted into the map.
int NumGrown(KeyframePolicy& policy, const Pose& pose, int num) {
  int num_grown = 0;
  for (int i = 0; i < num; ++i) {
    if (!policy.IsKeyframe(pose)) continue;
    policy.Accept(pose);
    ++num_grown;
  }
  return num_grown;
}

TEST(KeyframePolicy, StandstillGrowsTheMapAFewTimesOnly) {
  KeyframePolicy policy;
  const int num_grown = NumGrown(policy, At(0.0), 1000);
  EXPECT_GE(num_grown, 2);
  EXPECT_LE(num_grown, 6);
}

TEST(KeyframePolicy, MovingOnGrowsItAgain) {
  KeyframePolicy policy;
  NumGrown(policy, At(0.0), 100);
  EXPECT_FALSE(policy.IsKeyframe(At(0.1)));
  EXPECT_TRUE(policy.IsKeyframe(At(0.3)));
  EXPECT_TRUE(policy.IsKeyframe(At(0.0, 0.05)));
}

TEST(KeyframePolicy, CreepingGrowsItByTheWayNotByTheTime) {
  KeyframePolicy policy;
  int num_grown = 0;
  for (int i = 0; i < 1000; ++i) {  // 1 mm a scan, a metre in all
    num_grown += NumGrown(policy, At(0.001 * i), 1);
  }
  EXPECT_GE(num_grown, 5);
  EXPECT_LE(num_grown, 30);
}

TEST(KeyframePolicy, AskingChangesNothing) {
  KeyframePolicy policy;
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(policy.IsKeyframe(At(0.0)));
}

TEST(KeyframePolicy, ResetBeginsAnew) {
  KeyframePolicy policy;
  NumGrown(policy, At(0.0), 100);
  policy.Reset();
  EXPECT_TRUE(policy.IsKeyframe(At(0.0)));
}

}  // namespace
}  // namespace lio
