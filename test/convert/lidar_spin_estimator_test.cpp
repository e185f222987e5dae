// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/lidar_spin_estimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lio/io/input_error.hpp"
#include "support/seen_clouds.hpp"

namespace lio {
namespace {

using test::AsFired;
using test::kTurn_rad;
using test::WorstError;

TEST(LidarSpinEstimator, LearnsTheRingsAzimuthOffsets) {
  test::SpinningLidar lidar{.num_rings = 8, .num_columns = 1810, .columns_per_turn = 1800};
  for (int ring = 0; ring < lidar.num_rings; ++ring) {
    lidar.offset_deg.push_back(ring % 4 == 0   ? -6.0
                               : ring % 4 == 1 ? 2.0
                               : ring % 4 == 2 ? 6.5
                                               : -2.5);
  }
  // Unknown offsets of 6.5 deg would be 1.8 ms; known ones leave a column's width, 0.056 ms.
  EXPECT_LT(WorstError(lidar, AsFired), 6e-5);
}

TEST(LidarSpinEstimator, AveragesTheStampsJitter) {
  // A jitter of 1 ms on both ends of nine sweeps is at most 0.22 % of the rate, 0.22 ms at the end.
  EXPECT_LT(WorstError({}, AsFired, true, false, 1e-3), 2.5e-4);
}

TEST(LidarSpinEstimator, CutsUnorderedPointsBehindTheSensor) {
  LidarSpinEstimator observer;
  test::SeenCloud cloud;
  for (int k = 0; k < 5; ++k) {
    cloud = test::MakeCloud({.num_columns = 356}, k, [](auto& seen) {
      std::shuffle(seen.begin(), seen.end(), std::mt19937(4));
    });
    observer.Add(cloud.points, cloud.rings, cloud.start);
  }
  const SpinModel model = observer.Decide({});
  EXPECT_EQ(model.order, PointOrder::kNone);
  EXPECT_NEAR(model.rate_radps, kTurn_rad / 0.1, 0.01);
  const UnwrappedSweep sweep = UnwrapAzimuth(model, cloud.points, cloud.rings);
  for (std::size_t i = 0; i < cloud.seen.size(); ++i) {
    const double behind_first = std::numbers::pi - std::atan2(cloud.seen[i].y, cloud.seen[i].x);
    EXPECT_NEAR(sweep.turned_rad[i], behind_first, 1e-5);
  }
}

TEST(LidarSpinEstimator, RefusesUnorderedPointsInFrontOnly) {
  LidarSpinEstimator observer;
  for (int k = 0; k < 5; ++k) {
    const test::SeenCloud cloud = test::MakeCloud({.num_columns = 60}, 0, [](auto& seen) {
      std::shuffle(seen.begin(), seen.end(), std::mt19937(4));
    });
    observer.Add(cloud.points, cloud.rings, cloud.start);
  }
  EXPECT_THROW((void)observer.Decide({}), InputError);
}

}  // namespace
}  // namespace lio
