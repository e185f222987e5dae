// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/keyframe_policy.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

Pose OnGroundAt(double x_m, double yaw_rad = 0.0) {
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

TEST(KeyframePolicy, StandstillGrowsTheMapFourTimesOnly) {
  KeyframePolicy policy;
  EXPECT_EQ(NumGrown(policy, OnGroundAt(0.0), 1000), 4);
}

TEST(KeyframePolicy, MovingOnGrowsItFourTimesAgain) {
  KeyframePolicy policy;
  for (const double x_m : {0.0, 0.3, 0.0}) {
    EXPECT_EQ(NumGrown(policy, OnGroundAt(x_m), 100), 4) << x_m;
  }
}

// Motion counts from the last place, whatever that is: 20 cm in any direction, or 0.03 rad.
TEST(KeyframePolicy, OtherSurfacesAreSeenAfter20CentimetresOr30Milliradians) {
  KeyframePolicy policy;
  const Pose here = OnGroundAt(50.0, 1.0);
  NumGrown(policy, here, 100);
  const auto is_keyframe_after = [&](const Vector3& shift_m, const Vector3& turn_rad) {
    return policy.IsKeyframe(here * Pose{ExpSo3(turn_rad), shift_m});
  };
  for (const int axis : {0, 1, 2}) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3 along = sign * Vector3::Unit(axis);
      EXPECT_FALSE(is_keyframe_after(0.199 * along, Vector3::Zero())) << along;
      EXPECT_TRUE(is_keyframe_after(0.201 * along, Vector3::Zero())) << along;
      EXPECT_FALSE(is_keyframe_after(Vector3::Zero(), 0.0299 * along)) << along;
      EXPECT_TRUE(is_keyframe_after(Vector3::Zero(), 0.0301 * along)) << along;
    }
  }
}

TEST(KeyframePolicy, CreepingGrowsItByTheWayNotByTheTime) {
  KeyframePolicy policy;
  int num_grown = 0;
  for (int i = 0; i < 1000; ++i) {  // 1.5 mm a scan
    num_grown += NumGrown(policy, OnGroundAt(0.0015 * i), 1);
  }
  EXPECT_EQ(num_grown, 4 * 8);  // at 0 and after each 134th scan, the first one beyond 20 cm
}

TEST(KeyframePolicy, AskingChangesNothing) {
  KeyframePolicy policy;
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(policy.IsKeyframe(OnGroundAt(0.0)));
}

TEST(KeyframePolicy, ResetBeginsAnew) {
  KeyframePolicy policy;
  NumGrown(policy, OnGroundAt(0.0), 100);
  policy.Reset();
  EXPECT_EQ(NumGrown(policy, OnGroundAt(0.0), 100), 4);
}

}  // namespace
}  // namespace lio
