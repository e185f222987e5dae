// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/azimuth_time.hpp"

#include <gtest/gtest.h>

#include "support/seen_clouds.hpp"

namespace lio {
namespace {

using test::AsFired;
using test::kTurn_rad;
using test::WorstError;

// Float coordinates at 10 m are accurate to 1 um, which is an azimuth of 1e-7 rad and 2 ns. When
// points come ring by ring, the start is that of the median ring, half a firing cycle off.
constexpr double kFloatError = 1e-7;

TEST(AzimuthTime, IsExactAcrossTheSeamInFiringOrder) {
  for (const double direction : {-1.0, 1.0}) {
    EXPECT_LT(WorstError({.direction = direction}, AsFired), kFloatError);
    EXPECT_LT(WorstError({.direction = direction}, AsFired, false), kFloatError);
  }
}

TEST(AzimuthTime, IsExactRingByRing) {
  const test::SpinningLidar lidar;
  EXPECT_LT(WorstError(lidar, test::RingByRing), lidar.num_rings * lidar.firing_s);
}

TEST(AzimuthTime, CountsBackFromAStampAtTheEnd) {
  EXPECT_LT(WorstError({}, AsFired, true, true), kFloatError);
}

TEST(AzimuthTime, IsNotMisledByGapsInTheReturns) {
  const auto with_gaps = [](std::vector<test::SeenPoint>& seen) {
    std::erase_if(seen, [](const auto& point) {
      const bool behind = point.column > 150 && point.column < 270;  // 120 deg without returns
      const bool sky = point.ring > 8 && point.column % 90 > 20;
      return behind || sky;
    });
  };
  EXPECT_LT(WorstError({}, with_gaps), kFloatError);
  EXPECT_LT(WorstError({}, with_gaps, false), kFloatError);
}

TEST(AzimuthTime, IsNotMisledByStrayPoints) {
  const auto with_strays = [](std::vector<test::SeenPoint>& seen) {
    for (std::size_t i = 1; i < seen.size(); i += 50) {
      test::SeenPoint stray = seen[i];
      stray.x = 0.01;
      stray.y = i % 100 == 1 ? 0.02 : -0.03;
      stray.time_s = -1.0;  // not compared
      seen[i] = stray;
    }
  };
  const test::SpinningLidar lidar;
  LidarSpinEstimator observer;
  for (int k = 0; k < 10; ++k) {
    const test::SeenCloud cloud = test::MakeCloud(lidar, k, with_strays);
    observer.Add(cloud.points, cloud.rings, cloud.start);
  }
  const SpinModel model = observer.Decide({});
  const test::SeenCloud cloud = test::MakeCloud(lidar, 10, with_strays);
  const auto instants = AzimuthInstants(UnwrapAzimuth(model, cloud.points, cloud.rings),
                                        model.rate_radps, cloud.start, false);
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (cloud.seen[i].time_s < 0.0) continue;
    EXPECT_NEAR(SecondsBetween(cloud.start, Timestamp{instants[i]}), cloud.seen[i].time_s, 1e-5);
  }
}

TEST(SpinRate, FollowsTheHeadAndLeavesOutLostSweeps) {
  test::SpinningLidar lidar;
  SpinRate rate(kTurn_rad / 0.1);
  lidar.turn_s = 0.102;
  for (int k = 0; k < 200; ++k) {
    if (k % 7 == 3) continue;
    const test::SeenCloud cloud = test::MakeCloud(lidar, k, AsFired);
    SpinModel model;
    rate.Add(cloud.start, UnwrapAzimuth(model, cloud.points, cloud.rings), -1.0);
  }
  EXPECT_NEAR(rate.radps(), kTurn_rad / 0.102, 0.01);
}

TEST(TurnBetween, PicksTheTurnNearestToWhatTheSweepCovers) {
  const double degree = kTurn_rad / 360.0;
  EXPECT_NEAR(TurnBetween(-37 * degree, -39.4 * degree, 362 * degree, -1.0), 362.4 * degree, 1e-9);
  EXPECT_NEAR(TurnBetween(179 * degree, -179 * degree, 178 * degree, 1.0), 2 * degree, 1e-9);
}

}  // namespace
}  // namespace lio
