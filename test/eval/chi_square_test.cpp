// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/chi_square.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

// The expected values are from printed tables of the distribution.
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

// There are 300 degrees of freedom: printed tables give 253.912 and 349.874.
TEST(ChiSquare, BandOfFiftyRunsOfSixDegrees) {
  const Band fifty = MeanBandPerDof(6, 50);
  EXPECT_NEAR(fifty.low, 253.912 / 300, 1e-5);
  EXPECT_NEAR(fifty.high, 349.874 / 300, 1e-5);
  EXPECT_TRUE(fifty.Contains(1.1));
  EXPECT_FALSE(fifty.Contains(1.2));
}

}  // namespace
}  // namespace lio
