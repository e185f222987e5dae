// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/chi_square.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

namespace lio {
namespace {

TEST(ChiSquare, QuantilesAgreeWithPrintedTables) {
  // Printed tables of the chi-square distribution with 6 degrees of freedom give three decimals.
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
  EXPECT_EQ(ChiSquareCdf6(0.0), 0.0);
  EXPECT_EQ(ChiSquareCdf6(-3.0), 0.0);
  EXPECT_NEAR(ChiSquareQuantile6(0.0), 0.0, 1e-6);
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
  EXPECT_THROW(ChiSquareQuantile6(-0.1), std::invalid_argument);
  EXPECT_THROW(ChiSquareQuantile6(1.0), std::invalid_argument);
  EXPECT_THROW(ChiSquareQuantile6(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace lio
