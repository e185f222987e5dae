// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/banded_series.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace lio {
namespace {

// Returns squares of `dof` standard normals, times `scale`, at 10 Hz.
std::vector<TimedValues> Squares(int num_runs, int dof, double scale, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<TimedValues> runs(static_cast<std::size_t>(num_runs));
  for (TimedValues& run : runs) {
    for (int k = 0; k < 200; ++k) {
      double sum = 0;
      for (int i = 0; i < dof; ++i) sum += std::pow(normal(random), 2);
      run.push_back({0.1 * k, scale * sum});
    }
  }
  return runs;
}

TEST(BandedSeries, HonestSquaresLieInTheBandAndMisScaledOnesOutside) {
  const BandedSeries honest = MakeBandedSeries(Squares(100, 3, 1.0, 1), 3);
  EXPECT_EQ(honest.mean_per_dof.size(), 200u);
  EXPECT_NEAR(honest.average_per_dof, 1.0, 0.02);
  EXPECT_GT(honest.share_in_band, 0.9);
  EXPECT_LT(honest.share_in_band, 0.99);
  EXPECT_LT(MakeBandedSeries(Squares(100, 3, 1.5, 1), 3).share_in_band, 0.2);
}

TEST(BandedSeries, BandIsThatOfTheRunsThereAreAtAnInstant) {
  std::vector<TimedValues> runs = Squares(10, 3, 1.0, 2);
  runs[0].resize(100);
  const BandedSeries series = MakeBandedSeries(runs, 3);
  EXPECT_EQ(series.band_per_dof.front().high, MeanBandPerDof(3, 10).high);
  EXPECT_EQ(series.band_per_dof.back().high, MeanBandPerDof(3, 9).high);
}

TEST(Whiteness, TellsWhiteFromCorrelatedValues) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<TimedValues> white(100), smooth(100);
  for (std::size_t run = 0; run < white.size(); ++run) {
    double last = 0;
    for (int k = 0; k < 200; ++k) {
      const double x = normal(random);
      white[run].push_back({0.1 * k, x});
      smooth[run].push_back({0.1 * k, x + 0.5 * last});
      last = x;
    }
  }
  EXPECT_GE(ComputeWhiteness(white, 0.0).share_in_band, 0.85);
  const Whiteness correlated = ComputeWhiteness(smooth, 0.0);
  EXPECT_NEAR(correlated.autocorrelation[0], 0.4, 0.02);  // 0.5 / (1 + 0.25)
  EXPECT_NEAR(correlated.autocorrelation[1], 0.0, 0.02);
}

TEST(SigmaShares, CountWhatLiesInside) {
  const SigmaShares shares = SharesWithin({-0.5, 1.5, -2.5, 9.0});
  EXPECT_EQ(shares[0], 0.25);
  EXPECT_EQ(shares[1], 0.5);
  EXPECT_EQ(shares[2], 0.75);
}

TEST(NormalisedSquare, TakesCorrelationIntoAccount) {
  Eigen::Matrix2d cov;
  cov << 4.0, 1.0, 1.0, 1.0;
  const Eigen::Vector2d error(1.0, 2.0);
  EXPECT_NEAR(NormalisedSquare(error, cov), error.dot(cov.inverse() * error), 1e-12);
}

}  // namespace
}  // namespace lio
