// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/unseen_motion.hpp"

#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio {
namespace {

// Returns one second that turns at half a radian a second about z.
std::vector<ImuSample> Turning() {
  std::vector<ImuSample> samples;
  for (int i = 0; i <= 100; ++i) samples.push_back({test::StampAt(0.01 * i), Vector3(0, 0, 0.5)});
  return samples;
}

TEST(UnseenMotion, AMotionIsHiddenByOneSampleThatIsNotMeasured) {
  std::vector<ImuSample> samples = Turning();
  EXPECT_FALSE(IsMotionHidden(samples));
  samples[50].is_force_saturated = true;
  EXPECT_TRUE(IsMotionHidden(samples));
  EXPECT_TRUE(IsMotionHidden({}));
}

TEST(UnseenMotion, ARightRigHidesNothing) {
  const UnseenMotion unseen = MotionByRigErrors({}, Turning(), 3.0);
  EXPECT_EQ(unseen.translation_m, 0.0);
  EXPECT_EQ(unseen.rotation_rad, 0.0);
}

TEST(UnseenMotion, ALeverArmAcrossTheTurnMovesByItsLengthTimesTheTurn) {
  const auto shift_by = [](const Vector3& lever_m) {
    return MotionByRigErrors({Vector3::Zero(), lever_m, 0.0}, Turning(), 3.0).translation_m;
  };
  EXPECT_NEAR(shift_by({0.2, 0.0, 0.0}), 0.2 * 0.5, 1e-9);
  EXPECT_NEAR(shift_by({0.0, 0.2, 0.0}), 0.2 * 0.5, 1e-9);
  EXPECT_EQ(shift_by({0.0, 0.0, 0.2}), 0.0);
}

TEST(UnseenMotion, ATurnedExtrinsicTurnsThePath) {
  const UnseenMotion unseen = MotionByRigErrors({Vector3(0.0, 0.03, 0.0), {}, 0.0}, Turning(), 3.0);
  EXPECT_NEAR(unseen.translation_m, 0.03 * 3.0, 1e-9);
  EXPECT_NEAR(unseen.rotation_rad, 0.03 * 0.5, 1e-9);
}

TEST(UnseenMotion, StampsThatAreOffMoveAtTheSpeedAndTheRate) {
  const UnseenMotion unseen =
      MotionByRigErrors({Vector3::Zero(), Vector3::Zero(), 0.01}, Turning(), 3.0);
  EXPECT_NEAR(unseen.translation_m, 0.01 * 3.0, 1e-12);
  EXPECT_NEAR(unseen.rotation_rad, 0.01 * 0.5, 1e-12);
}

}  // namespace
}  // namespace lio
