// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/matched_pose.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

// A body that has turned by a quarter about the vertical and looks back on where it was.
struct TwoPoses {
  MatchedPose then, now;
  TwoPoses() {
    now.T_any_imu = {ExpSo3(Vector3(0, 0, 0.5 * M_PI)), Vector3(0.3, 0, 0)};
    then.cov.diagonal().setConstant(1e-4);
    now.cov.diagonal().setConstant(1e-4);
  }
};

TEST(ShownBetween, AMotionBeyondItsErrorsIsShownInFull) {
  const TwoPoses poses;
  const ShownMotion shown = ShownBetween(poses.then, poses.now);
  EXPECT_NEAR(shown.shift_m, 0.3, 1e-12);
  EXPECT_NEAR(shown.turn_rad, 0.5 * M_PI, 1e-12);
  EXPECT_NEAR(shown.turn_std_rad, std::sqrt(2e-4), 1e-12);
}

TEST(ShownBetween, TheTurnIsAsUnsureAsAboutTheAxisThatIsHeldLeast) {
  TwoPoses poses;
  poses.then.cov(3, 3) = 0.04;  // about x of the first one, y of the second one
  poses.now.cov(4, 4) = 0.05;
  EXPECT_NEAR(ShownBetween(poses.then, poses.now).turn_std_rad, 0.3, 1e-12);
}

TEST(ShownBetween, AShiftAlongADirectionThatEitherScanLeavesOpenIsNone) {
  TwoPoses then_open, now_open, across;
  then_open.then.cov(0, 0) = 1e4;  // x of the first one
  now_open.now.cov(1, 1) = 1e4;    // the same direction in the axes of the second one
  across.now.cov(0, 0) = 1e4;
  EXPECT_EQ(ShownBetween(then_open.then, then_open.now).shift_m, 0.0);
  EXPECT_EQ(ShownBetween(now_open.then, now_open.now).shift_m, 0.0);
  EXPECT_NEAR(ShownBetween(across.then, across.now).shift_m, 0.3, 1e-12);
}

TEST(ShownBetween, ATurnWithinThreeSigmaIsNone) {
  TwoPoses poses;
  poses.now.T_any_imu.rotation = ExpSo3(Vector3(0.04, 0, 0));  // sigma: 0.0141 rad
  EXPECT_EQ(ShownBetween(poses.then, poses.now).turn_rad, 0.0);
  poses.now.T_any_imu.rotation = ExpSo3(Vector3(0.045, 0, 0));
  EXPECT_NEAR(ShownBetween(poses.then, poses.now).turn_rad, 0.045, 1e-12);
}

TEST(ShownBetween, ExactPosesThatAreTheSameShowNothing) {
  const ShownMotion shown = ShownBetween({}, {});
  EXPECT_EQ(shown.shift_m, 0.0);
  EXPECT_EQ(shown.turn_rad, 0.0);
}

}  // namespace
}  // namespace lio
