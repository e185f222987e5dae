// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/chi_square.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace lio {
namespace {

// P(X <= x) with six degrees of freedom: the closed form that even ones have.
double ChiSquareCdf6(double x) {
  const double h = 0.5 * x;
  return 1.0 - std::exp(-h) * (1.0 + h + 0.5 * h * h);
}

TEST(ChiSquare, QuantilesOfSixDegreesAgreeWithPrintedTables) {
  // Tables of the chi-square distribution, 6 degrees of freedom, give three decimals.
  EXPECT_NEAR(ChiSquareQuantile6(0.05), 1.635, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile6(0.50), 5.348, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile6(0.95), 12.592, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile6(0.99), 16.812, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile6(0.999), 22.458, 5e-4);
}

TEST(ChiSquare, QuantileInvertsTheDistribution) {
  for (const double p : {1e-9, 1e-3, 0.1, 0.5, 0.9, 0.999, 1 - 1e-9}) {
    EXPECT_NEAR(ChiSquareCdf6(ChiSquareQuantile6(p)), p, 1e-12) << p;
  }
}

TEST(ChiSquare, NothingLiesBelowZero) {
  EXPECT_NEAR(ChiSquareQuantile6(0.0), 0.0, 1e-6);
}

// The tables of the distribution are printed ones.
TEST(ChiSquare, QuantilesEqualTheTables) {
  EXPECT_NEAR(ChiSquareQuantile(0.95, 3), 7.815, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.99, 3), 11.345, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.95, 6), 12.592, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.999, 6), 22.458, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.025, 6), 1.237, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.975, 100), 129.561, 5e-4);
}

TEST(ChiSquare, TwoDegreesAreAnExponential) {
  for (const double probability : {0.001, 0.5, 0.999999}) {
    EXPECT_NEAR(ChiSquareQuantile(probability, 2), -2 * std::log1p(-probability), 1e-9);
  }
}

TEST(ChiSquare, SumsOfSixSquaredNormalsFollowIt) {
  constexpr int kDraws = 20000;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const double median = ChiSquareQuantile6(0.5);
  int num_below = 0;
  for (int i = 0; i < kDraws; ++i) {
    double sum = 0;
    for (int k = 0; k < 6; ++k) {
      const double x = normal(random);
      sum += x * x;
    }
    num_below += sum < median ? 1 : 0;
  }
  EXPECT_NEAR(num_below, kDraws / 2, 4 * 71);  // four standard deviations of a fair coin
}

TEST(ChiSquare, RefusesWhatIsNoProbability) {
  EXPECT_THROW((void)ChiSquareQuantile6(-0.1), std::invalid_argument);
  EXPECT_THROW((void)ChiSquareQuantile(0.5, 0.0), std::invalid_argument);
  EXPECT_THROW((void)ChiSquareQuantile6(1.0), std::invalid_argument);
  EXPECT_THROW((void)ChiSquareQuantile6(std::numeric_limits<double>::quiet_NaN()),
               std::invalid_argument);
}

}  // namespace
}  // namespace lio
