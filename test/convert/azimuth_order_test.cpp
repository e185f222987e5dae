// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/azimuth_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/spinning_lidar.hpp"

namespace lio {
namespace {

struct Cloud {
  CloudPoints points;
  std::vector<std::uint16_t> rings;
};

Cloud CloudOf(std::vector<test::SeenPoint> seen) {
  Cloud cloud;
  for (const auto& point : seen) {
    cloud.points.x_m.push_back(static_cast<float>(point.x));
    cloud.points.y_m.push_back(static_cast<float>(point.y));
    cloud.points.z_m.push_back(static_cast<float>(point.z));
    cloud.rings.push_back(static_cast<std::uint16_t>(point.ring));
  }
  return cloud;
}

TEST(AzimuthOrder, SeesFiringOrderAndDirectionWithAndWithoutRings) {
  for (const double direction : {-1.0, 1.0}) {
    const Cloud cloud = CloudOf(test::SeePoints({.direction = direction}, 0));
    for (const bool with_rings : {true, false}) {
      const OrderVote vote =
          JudgeOrder(cloud.points, with_rings ? std::span<const std::uint16_t>(cloud.rings)
                                              : std::span<const std::uint16_t>());
      EXPECT_EQ(vote.order, PointOrder::kFiring);
      EXPECT_EQ(vote.direction, direction);
    }
  }
}

TEST(AzimuthOrder, SeesRingByRing) {
  auto seen = test::SeePoints({}, 0);
  std::stable_sort(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.ring < b.ring; });
  const Cloud cloud = CloudOf(seen);
  const OrderVote vote = JudgeOrder(cloud.points, cloud.rings);
  EXPECT_EQ(vote.order, PointOrder::kByRing);
  EXPECT_EQ(vote.direction, -1.0);
  EXPECT_EQ(JudgeOrder(cloud.points, {}).order, PointOrder::kNone);
}

TEST(AzimuthOrder, SeesThatShuffledPointsHaveNone) {
  auto seen = test::SeePoints({}, 0);
  std::shuffle(seen.begin(), seen.end(), std::mt19937(1));
  const Cloud cloud = CloudOf(seen);
  EXPECT_EQ(JudgeOrder(cloud.points, cloud.rings).order, PointOrder::kNone);
  EXPECT_EQ(JudgeOrder(cloud.points, {}).order, PointOrder::kNone);
}

TEST(AzimuthOrder, MeasuresCoverage) {
  EXPECT_EQ(CoverageOfCircle(CloudOf(test::SeePoints({}, 0)).points), 1.0);
  const auto quarter = test::SeePoints({.num_columns = 80, .columns_per_turn = 356}, 0);
  EXPECT_NEAR(CoverageOfCircle(CloudOf(quarter).points), 0.25, 0.03);
  EXPECT_EQ(CoverageOfCircle(CloudPoints()), 0.0);
}

TEST(Angles, WrapIntoTheirRanges) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_NEAR(WrappedAngle(1.5 * kPi), -0.5 * kPi, 1e-15);
  EXPECT_NEAR(WrappedAngle(-1.5 * kPi), 0.5 * kPi, 1e-15);
  EXPECT_NEAR(PositiveTurn(-0.5 * kPi), 1.5 * kPi, 1e-15);
  EXPECT_NEAR(PositiveTurn(4.5 * kPi), 0.5 * kPi, 1e-14);
}

}  // namespace
}  // namespace lio
