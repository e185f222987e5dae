// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "scan/ring_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/ray_scene.hpp"

namespace lio {
namespace {

LidarPoint PointTowards(double azimuth_rad, double elevation_rad, double range_m = 10.0) {
  LidarPoint point;
  point.x_m = static_cast<float>(range_m * std::cos(elevation_rad) * std::cos(azimuth_rad));
  point.y_m = static_cast<float>(range_m * std::cos(elevation_rad) * std::sin(azimuth_rad));
  point.z_m = static_cast<float>(range_m * std::sin(elevation_rad));
  return point;
}

TEST(RingOrder, RingIsTheNearestBeamWhateverItsSpacing) {
  const std::vector<double> beams{-0.4, -0.2, -0.15, 0.0, 0.3};
  const std::vector<LidarPoint> points{PointTowards(1, -0.9),  PointTowards(2, -0.31),
                                       PointTowards(3, -0.29), PointTowards(-1, -0.16),
                                       PointTowards(-2, 0.14), PointTowards(-3, 0.16),
                                       PointTowards(0, 1.2)};
  EXPECT_EQ(RingsFromElevation(points, beams), (std::vector<std::uint16_t>{0, 0, 1, 2, 3, 4, 4}));
}

TEST(RingOrder, TurnFractionsGrowClockwiseAcrossTheWrap) {
  std::vector<LidarPoint> points;
  constexpr int kNum = 100;
  for (int i = 0; i < kNum; ++i) {  // from -170 deg on: soon past the wrap at 180
    points.push_back(PointTowards(-2.967 - 2 * std::numbers::pi * i / kNum, 0.1));
  }
  const std::vector<float> fractions = TurnFractions(points);
  for (int i = 0; i < kNum; ++i) {
    EXPECT_NEAR(fractions[static_cast<std::size_t>(i)], static_cast<double>(i) / kNum, 1e-5);
  }
}

TEST(RingOrder, RebuiltTimesAgreeWithTheTrueOnes) {
  test::RayScene scene;
  scene.AddGround(-2);
  scene.Add(test::RayBox{{0, 12, 0}, {40, 1, 9}, 0.2});
  auto lidar = test::SpinningLidar::Hdl32e();
  lidar.start_azimuth_rad = 2.0;
  const Sweep sweep = CastTurn(scene, lidar, Pose::Identity()).sweep;
  const std::vector<float> fractions = TurnFractions(sweep.points);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    EXPECT_NEAR(fractions[i] * 1e8, sweep.points[i].t_offset_ns, 2e3);  // 2 us
  }
}

TEST(RingOrder, UnwantedPointsAreLeftOutAndRingsAreInOrderOfTime) {
  std::vector<LidarPoint> points(6);
  for (std::size_t i = 0; i < 6; ++i) {
    points[i] = PointTowards(0.1 * static_cast<double>(i), 0);
    points[i].ring = static_cast<std::uint16_t>(2 * (i % 2));
    points[i].t_offset_ns = static_cast<std::uint32_t>(100 - i);
  }
  points[2].x_m = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::uint8_t> wanted{1, 1, 0, 1, 1, 1};
  const RingOrder order = OrderByRing(points, {}, wanted);
  ASSERT_EQ(order.num_rings(), 3u);
  EXPECT_EQ(std::vector(order.ring(0).begin(), order.ring(0).end()),
            (std::vector<std::uint32_t>{4, 0}));
  EXPECT_EQ(order.ring(1).size(), 0u);
  EXPECT_EQ(std::vector(order.ring(2).begin(), order.ring(2).end()),
            (std::vector<std::uint32_t>{5, 3, 1}));
}

TEST(RingOrder, EmptySweepHasNoRings) {
  EXPECT_EQ(OrderByRing({}, {}, {}).num_rings(), 0u);
  EXPECT_TRUE(TurnFractions({}).empty());
}

}  // namespace
}  // namespace lio
