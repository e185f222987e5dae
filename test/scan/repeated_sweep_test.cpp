// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/repeated_sweep.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

Sweep SweepOf(std::size_t num_points, float range_m) {
  Sweep sweep;
  for (std::size_t i = 0; i < num_points; ++i) {
    LidarPoint point{};
    point.x_m = range_m;
    point.y_m = 0.01f * static_cast<float>(i);
    point.ring = static_cast<std::uint16_t>(i % 16);
    sweep.points.push_back(point);
  }
  return sweep;
}

TEST(RepeatedSweep, TheSamePointsAgainAreARepetition) {
  RepeatedSweepDetector detector;
  EXPECT_FALSE(detector.IsRepeated(SweepOf(5000, 10.f)));
  EXPECT_TRUE(detector.IsRepeated(SweepOf(5000, 10.f)));
  EXPECT_TRUE(detector.IsRepeated(SweepOf(5000, 10.f)));
  EXPECT_FALSE(detector.IsRepeated(SweepOf(5000, 10.001f)));
  EXPECT_TRUE(detector.IsRepeated(SweepOf(5000, 10.001f)));
}

TEST(RepeatedSweep, AnotherNumberOfPointsIsNone) {
  RepeatedSweepDetector detector;
  EXPECT_FALSE(detector.IsRepeated(SweepOf(5000, 10.f)));
  EXPECT_FALSE(detector.IsRepeated(SweepOf(4999, 10.f)));
}

TEST(RepeatedSweep, SweepsWithoutPointsAreNone) {
  RepeatedSweepDetector detector;
  EXPECT_FALSE(detector.IsRepeated(Sweep{}));
  EXPECT_FALSE(detector.IsRepeated(Sweep{}));
}

TEST(RepeatedSweep, AFewPointsAreComparedAll) {
  RepeatedSweepDetector detector;
  EXPECT_FALSE(detector.IsRepeated(SweepOf(3, 10.f)));
  Sweep other = SweepOf(3, 10.f);
  other.points[1].z_m = 1.f;
  EXPECT_FALSE(detector.IsRepeated(other));
  EXPECT_TRUE(detector.IsRepeated(other));
}

}  // namespace
}  // namespace lio
