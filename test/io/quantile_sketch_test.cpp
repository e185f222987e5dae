// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/quantile_sketch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace lio {
namespace {

double Exact(const std::vector<double>& sorted, double fraction) {
  return sorted[static_cast<std::size_t>(
      std::lround(fraction * static_cast<double>(sorted.size() - 1)))];
}

// Times of computing as they are: a bulk around `median`, and rare values many times as long.
std::vector<double> RandomStageTimes(std::size_t count, double median, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::lognormal_distribution<double> time(std::log(median), 0.7);
  std::vector<double> times(count);
  for (double& t : times) t = time(generator);
  return times;
}

TEST(QuantileSketch, AShortRunsQuantilesAreExact) {
  QuantileSketch sketch;
  std::vector<double> values = RandomStageTimes(QuantileSketch::kMaxExact, 12.0, 1);
  for (const double value : values) sketch.Add(value);
  std::sort(values.begin(), values.end());
  for (const double fraction : {0.0, 0.25, 0.5, 0.99, 1.0}) {
    EXPECT_EQ(sketch.Quantile(fraction), Exact(values, fraction)) << fraction;
  }
}

TEST(QuantileSketch, ALongRunsQuantilesAreRightToOnePercent) {
  for (const double median : {3e-4, 0.1, 12.0, 4000.0}) {
    QuantileSketch sketch;
    std::vector<double> values = RandomStageTimes(20'000, median, 2);
    for (const double value : values) sketch.Add(value);
    std::sort(values.begin(), values.end());
    for (const double fraction : {0.01, 0.5, 0.9, 0.99, 0.999}) {
      const double exact = Exact(values, fraction);
      EXPECT_NEAR(sketch.Quantile(fraction), exact, 0.01 * exact) << median << " " << fraction;
    }
    EXPECT_EQ(sketch.min(), Exact(values, 0.0));
    EXPECT_EQ(sketch.max(), Exact(values, 1.0));
  }
}

TEST(QuantileSketch, ItsMemoryIsBounded) {
  QuantileSketch sketch;
  std::size_t most_bytes = 0;
  for (const double value : RandomStageTimes(50'000, 12.0, 3)) {
    sketch.Add(value);
    most_bytes = std::max(most_bytes, sketch.memory_bytes());
  }
  EXPECT_LE(most_bytes, 32'768u);
  EXPECT_LE(sketch.memory_bytes(), 23'000u);
}

TEST(QuantileSketch, TheOrderOfTheValuesDoesNotMatter) {
  std::vector<double> values = RandomStageTimes(10'000, 5.0, 4);
  QuantileSketch one;
  for (const double value : values) one.Add(value);
  std::reverse(values.begin(), values.end());
  QuantileSketch other;
  for (const double value : values) other.Add(value);
  for (const double fraction : {0.1, 0.5, 0.99}) {
    EXPECT_EQ(one.Quantile(fraction), other.Quantile(fraction));
  }
}

TEST(QuantileSketch, ZerosAndHugeValuesAreCountedAtTheEnds) {
  QuantileSketch sketch;
  for (int i = 0; i < 6000; ++i) sketch.Add(0.0);
  for (int i = 0; i < 4000; ++i) sketch.Add(1e9);
  EXPECT_NEAR(sketch.Quantile(0.5), 0.0, 1.01e-6);
  EXPECT_EQ(sketch.Quantile(0.0), sketch.Quantile(0.5));
  EXPECT_NEAR(sketch.Quantile(0.99), QuantileSketch::kMaxBinned, 0.01 * QuantileSketch::kMaxBinned);
  EXPECT_EQ(sketch.min(), 0.0);
  EXPECT_EQ(sketch.max(), 1e9);
}

TEST(QuantileSketch, EqualValuesAreTheirOwnQuantilesHoweverMany) {
  QuantileSketch sketch;
  for (int i = 0; i < 10'000; ++i) sketch.Add(7.25);
  EXPECT_EQ(sketch.Quantile(0.5), 7.25);
}

TEST(QuantileSketch, WithoutValuesThereIsNoQuantile) {
  const QuantileSketch sketch;
  EXPECT_TRUE(sketch.empty());
  EXPECT_THROW((void)sketch.Quantile(0.5), std::logic_error);
}

}  // namespace
}  // namespace lio
