// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/dense_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace lio {
namespace {

Sweep RandomSweep(std::size_t num_points) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> place(-50.f, 50.f);
  Sweep sweep;
  for (std::size_t i = 0; i < num_points; ++i) {
    LidarPoint point;
    point.x_m = place(random);
    point.y_m = place(random);
    point.z_m = 0.05f * place(random);
    point.t_offset_ns = static_cast<std::uint32_t>(i) * 1000;
    point.ring = static_cast<std::uint16_t>(i % 32);
    sweep.points.push_back(point);
  }
  return sweep;
}

TEST(DensePoints, KeepsEveryWantedPointOfASmallSweepByTime) {
  Sweep sweep = RandomSweep(5000);
  sweep.points[7].x_m = std::numeric_limits<float>::quiet_NaN();
  LidarRig rig;
  rig.min_range_m = 10.0;
  const PointFilter filter(rig);
  const auto wanted = std::count_if(
      sweep.points.begin(), sweep.points.end(),
      [&](const LidarPoint& point) { return IsFinite(point) && filter.IsWanted(point); });
  const std::vector<ScanPoint> points = DensePoints(sweep, filter);
  ASSERT_EQ(points.size(), static_cast<std::size_t>(wanted));
  EXPECT_LT(points.size(), 5000u);
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.t_offset_ns < b.t_offset_ns;
  }));
}

TEST(DensePoints, SamplesALargeSweepWhateverTheOrder) {
  Sweep sweep = RandomSweep(120'000);
  const PointFilter filter{LidarRig{}};
  const std::vector<ScanPoint> points = DensePoints(sweep, filter);
  EXPECT_GT(points.size(), 28'000u);
  EXPECT_LT(points.size(), 36'000u);
  std::shuffle(sweep.points.begin(), sweep.points.end(), std::mt19937(5));
  const std::vector<ScanPoint> shuffled = DensePoints(sweep, filter);
  ASSERT_EQ(shuffled.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(shuffled[i].position, points[i].position);
  }
}

TEST(DensePoints, SamplesALargeCloudWithoutTimesOrRings) {
  Sweep sweep = RandomSweep(120'000);
  for (LidarPoint& point : sweep.points) {
    point.t_offset_ns = 0;
    point.ring = 0;
  }
  const std::vector<ScanPoint> points = DensePoints(sweep, PointFilter{LidarRig{}});
  EXPECT_GT(points.size(), 28'000u);
  EXPECT_LT(points.size(), 36'000u);
}

}  // namespace
}  // namespace lio
