// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/time_offset.hpp"

#include <gtest/gtest.h>

#include "eval/paths.hpp"

namespace lio {
namespace {

// The body speeds up along a bend; along a bend of constant speed any offset is an alignment.
Trajectory Drive() {
  return test::MakeTrajectory(300, [](int i) {
    const double s = 0.002 * i * i;
    return Pose{Quaternion::Identity(), {s, 20.0 * std::sin(0.05 * s), 0.3 * std::sin(0.2 * i)}};
  });
}

TEST(TimeOffset, IsFoundToAMillisecond) {
  for (const double offset_s : {0.0, 0.025, -0.31, 0.8}) {
    const Trajectory late = Shifted(Drive(), -offset_s);
    EXPECT_NEAR(FindTimeOffset(Drive(), late, std::nullopt), offset_s, 1e-3) << offset_s;
  }
}

TEST(TimeOffset, ShiftingChangesStampsAlone) {
  const Trajectory drive = Drive();
  const Trajectory shifted = Shifted(drive, 0.5);
  ASSERT_EQ(shifted.poses.size(), drive.poses.size());
  EXPECT_EQ((shifted.poses[7].stamp - drive.poses[7].stamp).ns, 500'000'000);
  EXPECT_EQ(shifted.poses[7].pose.translation, drive.poses[7].pose.translation);
}

TEST(TimeOffset, FilesWithoutStampsAreRefused) {
  Trajectory rows = Drive();
  rows.format = TrajectoryFormat::kKitti;
  EXPECT_THROW((void)FindTimeOffset(rows, rows, std::nullopt), std::runtime_error);
}

}  // namespace
}  // namespace lio
