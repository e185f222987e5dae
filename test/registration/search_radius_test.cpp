// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/search_radius.hpp"

#include <gtest/gtest.h>

#include "support/guess_cov.hpp"

namespace lio {
namespace {

using test::GuessCov;

TEST(SearchRadius, GrowsWithTheGuessAndTheRange) {
  const SearchRadius radius(GuessCov(0.1, 0.01));
  EXPECT_NEAR(radius.StdAt(0.0), 0.1, 1e-12);
  EXPECT_NEAR(radius.StdAt(10.0), std::sqrt(0.02), 1e-12);
  EXPECT_GT(radius.StdAt(50.0), 0.5);
}

TEST(SearchRadius, ShrinksToNothing) {
  SearchRadius radius(GuessCov(0.5, 0.05));
  double before = radius.StdAt(20.0);
  int num_steps = 0;
  while (!radius.IsExhausted()) {
    radius.Shrink();
    EXPECT_LT(radius.StdAt(20.0), before);
    before = radius.StdAt(20.0);
    ASSERT_LT(++num_steps, 10);
  }
  EXPECT_EQ(before, 0.0);
}

TEST(SearchRadius, AnExactGuessNeedsNone) {
  SearchRadius radius(Matrix6::Zero());
  EXPECT_EQ(radius.StdAt(30.0), 0.0);
  radius.Shrink();
  EXPECT_TRUE(radius.IsExhausted());
}

TEST(SearchRadius, IsBoundedHoweverPoorTheGuess) {
  const SearchRadius radius(GuessCov(1000.0, 10.0));
  EXPECT_LE(radius.StdAt(100.0), 2.0);
}

}  // namespace
}  // namespace lio
