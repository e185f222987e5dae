// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/range_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lio {
namespace {

// A ring between two walls, 4 and 7 m off, and leaves over `leaf_share` of it.
Sweep NoisySweep(unsigned seed, double noise_m, double leaf_share = 0.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, noise_m);
  std::uniform_real_distribution<double> leaf(-0.5, 0.5);
  Sweep sweep;
  for (int column = 0; column < 900; ++column) {
    const double azimuth = 0.007 * column;
    const double wall_m = std::sin(azimuth) > 0.0 ? 4.0 : 7.0;
    double range_m = std::min(20.0, wall_m / std::abs(std::sin(azimuth)) + 1e-3);
    range_m += column < leaf_share * 900 ? leaf(random) : noise(random);
    LidarPoint point;
    point.x_m = static_cast<float>(range_m * std::cos(azimuth));
    point.y_m = static_cast<float>(range_m * std::sin(azimuth));
    point.t_offset_ns = static_cast<std::uint32_t>(column) * 100'000;
    sweep.points.push_back(point);
    point.ring = 1;
    point.z_m = 0.1f * static_cast<float>(range_m);
    point.t_offset_ns += 1000;
    sweep.points.push_back(point);
  }
  return sweep;
}

float StdOf(double noise_m, double leaf_share = 0.0) {
  RangeNoiseEstimator estimator;
  MixedPixelFinder finder;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Sweep sweep = NoisySweep(seed, noise_m, leaf_share);
    finder.Load(sweep);
    estimator.Add(finder, sweep.points.size());
  }
  return estimator.std_m();
}

TEST(RangeNoise, IsThatOfTheRanges) {
  for (const double noise_m : {0.01, 0.03, 0.1}) {
    EXPECT_NEAR(StdOf(noise_m), noise_m, 0.15 * noise_m);
  }
}

TEST(RangeNoise, LeavesHardlyCount) {
  EXPECT_LT(StdOf(0.02, 0.4), 0.04);
}

TEST(RangeNoise, IsUnknownWithoutRings) {
  Sweep sweep = NoisySweep(1, 0.02);
  for (LidarPoint& point : sweep.points) point.ring = 0xFFFF;
  MixedPixelFinder finder;
  finder.Load(sweep);
  RangeNoiseEstimator estimator;
  estimator.Add(finder, sweep.points.size());
  EXPECT_EQ(estimator.std_m(), 0.f);
}

TEST(RangeNoise, FollowsASensorThatChanges) {
  RangeNoiseEstimator estimator;
  MixedPixelFinder finder;
  for (unsigned seed = 0; seed < 120; ++seed) {
    const Sweep sweep = NoisySweep(seed, seed < 20 ? 0.02 : 0.08);
    finder.Load(sweep);
    estimator.Add(finder, sweep.points.size());
  }
  EXPECT_NEAR(estimator.std_m(), 0.08, 0.012);
}

}  // namespace
}  // namespace lio
