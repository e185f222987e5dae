// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/azimuth_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lio/io/input_error.hpp"
#include "support/spinning_lidar.hpp"

namespace lio {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr Timestamp kBegin{1'556'268'000'000'000'000};

struct Cloud {
  Timestamp start;
  std::vector<test::SeenPoint> seen;
  CloudPoints points;
  std::vector<std::uint16_t> rings;
};

Cloud Make(const test::SpinningLidar& lidar, int k, auto&& arrange) {
  Cloud cloud;
  cloud.start = kBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
  cloud.seen = test::SeePoints(lidar, k);
  arrange(cloud.seen);
  for (const auto& point : cloud.seen) {
    cloud.points.x_m.push_back(static_cast<float>(point.x));
    cloud.points.y_m.push_back(static_cast<float>(point.y));
    cloud.points.z_m.push_back(static_cast<float>(point.z));
    cloud.rings.push_back(static_cast<std::uint16_t>(point.ring));
  }
  return cloud;
}

void AsFired(std::vector<test::SeenPoint>&) {}
void RingByRing(std::vector<test::SeenPoint>& seen) {
  std::stable_sort(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.ring < b.ring; });
}

// Decides on ten clouds and gives the largest error of the rebuilt times of later ones [s].
double WorstError(const test::SpinningLidar& lidar, auto&& arrange, bool with_rings = true,
                  bool stamp_is_end = false, double stamp_jitter_s = 0.0) {
  SpinObserver observer;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> jitter(-stamp_jitter_s, stamp_jitter_s);
  const auto rings = [&](const Cloud& cloud) {
    return with_rings ? std::span<const std::uint16_t>(cloud.rings)
                      : std::span<const std::uint16_t>();
  };
  for (int k = 0; k < 10; ++k) {
    const Cloud cloud = Make(lidar, k, arrange);
    observer.Add(cloud.points, rings(cloud), cloud.start + Duration::FromSeconds(jitter(random)));
  }
  const SpinModel model = observer.Decide({});
  double worst = 0.0;
  for (int k = 10; k < 13; ++k) {
    const Cloud cloud = Make(lidar, k, arrange);
    const UnwrappedSweep sweep = UnwrapAzimuth(model, cloud.points, rings(cloud));
    const auto last = std::max_element(cloud.seen.begin(), cloud.seen.end(),
                                       [](auto& a, auto& b) { return a.time_s < b.time_s; });
    const double stamp_s = stamp_is_end ? last->time_s : 0.0;
    const auto instants = AzimuthInstants(
        sweep, model.rate_radps, cloud.start + Duration::FromSeconds(stamp_s), stamp_is_end);
    for (std::size_t i = 0; i < instants.size(); ++i) {
      const double rebuilt = SecondsBetween(cloud.start, Timestamp{instants[i]});
      worst = std::max(worst, std::abs(rebuilt - cloud.seen[i].time_s));
    }
  }
  return worst;
}

// Float coordinates at 10 m are good to 1 um, an azimuth of 1e-7 rad, 2 ns; the ring by ring start
// is the median ring's, half a firing cycle off.
constexpr double kFloatError = 1e-7;

TEST(AzimuthTime, IsExactAcrossTheSeamInFiringOrder) {
  for (const double direction : {-1.0, 1.0}) {
    EXPECT_LT(WorstError({.direction = direction}, AsFired), kFloatError);
    EXPECT_LT(WorstError({.direction = direction}, AsFired, false), kFloatError);
  }
}

TEST(AzimuthTime, IsExactRingByRing) {
  const test::SpinningLidar lidar;
  EXPECT_LT(WorstError(lidar, RingByRing), lidar.num_rings * lidar.firing_s);
}

TEST(AzimuthTime, CountsBackFromAStampAtTheEnd) {
  EXPECT_LT(WorstError({}, AsFired, true, true), kFloatError);
}

TEST(AzimuthTime, LearnsTheRingsAzimuthOffsets) {
  test::SpinningLidar lidar{.num_rings = 8, .num_columns = 1810, .columns_per_turn = 1800};
  for (int ring = 0; ring < lidar.num_rings; ++ring) {
    lidar.offset_deg.push_back(ring % 4 == 0   ? -6.0
                               : ring % 4 == 1 ? 2.0
                               : ring % 4 == 2 ? 6.5
                                               : -2.5);
  }
  // Unknown offsets of 6.5 deg are 1.8 ms; known ones leave a column's width, 0.056 ms.
  EXPECT_LT(WorstError(lidar, AsFired), 6e-5);
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
  SpinObserver observer;
  for (int k = 0; k < 10; ++k) {
    const Cloud cloud = Make(lidar, k, with_strays);
    observer.Add(cloud.points, cloud.rings, cloud.start);
  }
  const SpinModel model = observer.Decide({});
  const Cloud cloud = Make(lidar, 10, with_strays);
  const auto instants = AzimuthInstants(UnwrapAzimuth(model, cloud.points, cloud.rings),
                                        model.rate_radps, cloud.start, false);
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (cloud.seen[i].time_s < 0.0) continue;
    EXPECT_NEAR(SecondsBetween(cloud.start, Timestamp{instants[i]}), cloud.seen[i].time_s, 1e-5);
  }
}

TEST(AzimuthTime, AveragesTheStampsJitter) {
  // 1 ms of jitter on both ends of nine sweeps: 0.22 % of the rate at most, 0.22 ms at the end.
  EXPECT_LT(WorstError({}, AsFired, true, false, 1e-3), 2.5e-4);
}

TEST(AzimuthTime, OfUnorderedPointsIsCutBehindTheSensor) {
  SpinObserver observer;
  Cloud cloud;
  for (int k = 0; k < 5; ++k) {
    cloud = Make({.num_columns = 356}, k,
                 [](auto& seen) { std::shuffle(seen.begin(), seen.end(), std::mt19937(4)); });
    observer.Add(cloud.points, cloud.rings, cloud.start);
  }
  const SpinModel model = observer.Decide({});
  EXPECT_EQ(model.order, PointOrder::kNone);
  EXPECT_NEAR(model.rate_radps, kTurn / 0.1, 0.01);
  const UnwrappedSweep sweep = UnwrapAzimuth(model, cloud.points, cloud.rings);
  for (std::size_t i = 0; i < cloud.seen.size(); ++i) {
    const double behind_first = std::numbers::pi - std::atan2(cloud.seen[i].y, cloud.seen[i].x);
    EXPECT_NEAR(sweep.turned_rad[i], behind_first, 1e-5);
  }
}

TEST(AzimuthTime, OfUnorderedPointsInFrontOnlyIsRefused) {
  SpinObserver observer;
  for (int k = 0; k < 5; ++k) {
    const Cloud cloud = Make({.num_columns = 60}, 0, [](auto& seen) {
      std::shuffle(seen.begin(), seen.end(), std::mt19937(4));
    });
    observer.Add(cloud.points, cloud.rings, cloud.start);
  }
  EXPECT_THROW(observer.Decide({}), InputError);
}

TEST(SpinRate, FollowsTheHeadAndLeavesOutLostSweeps) {
  test::SpinningLidar lidar;
  SpinRate rate(kTurn / 0.1);
  lidar.turn_s = 0.102;
  for (int k = 0; k < 200; ++k) {
    if (k % 7 == 3) continue;
    const Cloud cloud = Make(lidar, k, AsFired);
    SpinModel model;
    rate.Add(cloud.start, UnwrapAzimuth(model, cloud.points, cloud.rings), -1.0);
  }
  EXPECT_NEAR(rate.radps(), kTurn / 0.102, 0.01);
}

TEST(TurnBetween, PicksTheTurnNearestToWhatTheSweepCovers) {
  const double degree = kTurn / 360.0;
  EXPECT_NEAR(TurnBetween(-37 * degree, -39.4 * degree, 362 * degree, -1.0), 362.4 * degree, 1e-9);
  EXPECT_NEAR(TurnBetween(179 * degree, -179 * degree, 178 * degree, 1.0), 2 * degree, 1e-9);
}

}  // namespace
}  // namespace lio
