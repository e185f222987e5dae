// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes clouds of the spinning lidar as the converters hold them, for tests that rebuild point
// times.
#pragma once

#include <algorithm>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "lio/convert/lidar_spin_estimator.hpp"
#include "support/spinning_lidar.hpp"

namespace lio::test {

inline constexpr double kTurn_rad = 2.0 * std::numbers::pi;
inline constexpr Timestamp kBegin{1'556'268'000'000'000'000};

struct SeenCloud {
  Timestamp start;
  std::vector<SeenPoint> seen;
  CloudPoints points;
  std::vector<std::uint16_t> rings;
};

inline SeenCloud MakeCloud(const SpinningLidar& lidar, int k, auto&& arrange) {
  SeenCloud cloud;
  cloud.start = kBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
  cloud.seen = SeePoints(lidar, k);
  arrange(cloud.seen);
  for (const auto& point : cloud.seen) {
    cloud.points.x_m.push_back(static_cast<float>(point.x));
    cloud.points.y_m.push_back(static_cast<float>(point.y));
    cloud.points.z_m.push_back(static_cast<float>(point.z));
    cloud.rings.push_back(static_cast<std::uint16_t>(point.ring));
  }
  return cloud;
}

inline void AsFired(std::vector<SeenPoint>&) {}
inline void RingByRing(std::vector<SeenPoint>& seen) {
  std::stable_sort(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.ring < b.ring; });
}

// Decides on ten clouds and returns the largest error of the rebuilt times of later ones [s].
inline double WorstError(const SpinningLidar& lidar, auto&& arrange, bool with_rings = true,
                         bool stamp_is_end = false, double stamp_jitter_s = 0.0) {
  LidarSpinEstimator observer;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> jitter(-stamp_jitter_s, stamp_jitter_s);
  const auto rings = [&](const SeenCloud& cloud) {
    return with_rings ? std::span<const std::uint16_t>(cloud.rings)
                      : std::span<const std::uint16_t>();
  };
  for (int k = 0; k < 10; ++k) {
    const SeenCloud cloud = MakeCloud(lidar, k, arrange);
    observer.Add(cloud.points, rings(cloud), cloud.start + Duration::FromSeconds(jitter(random)));
  }
  const SpinModel model = observer.Decide({});
  double worst = 0.0;
  for (int k = 10; k < 13; ++k) {
    const SeenCloud cloud = MakeCloud(lidar, k, arrange);
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

}  // namespace lio::test
