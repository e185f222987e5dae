// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/chi_square.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

// Printed tables have 253.912 and 349.874 for 300 degrees.
TEST(ChiSquare, BandOfFiftyRunsOfSixDegrees) {
  const Band fifty = MeanBandPerDof(6, 50);
  EXPECT_NEAR(fifty.low, 253.912 / 300, 1e-5);
  EXPECT_NEAR(fifty.high, 349.874 / 300, 1e-5);
  EXPECT_TRUE(fifty.Contains(1.1));
  EXPECT_FALSE(fifty.Contains(1.2));
}

}  // namespace
}  // namespace lio
