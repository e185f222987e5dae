// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/stamp_correction.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

constexpr Duration Ms(int ms) {
  return {1'000'000 * std::int64_t{ms}};
}

void Learn(StampCorrection& corrections, std::size_t num_unmatched, Duration newest) {
  corrections.SetNewest(newest);
  corrections.Learn(num_unmatched);
}

// The correction of the next sweep, which is then given out and matched.
Duration GiveOut(StampCorrection& corrections) {
  corrections.Learn(0);
  const Duration correction = corrections.ForNextSweeps();
  corrections.CountSweep();
  return correction;
}

TEST(StampCorrection, ASweepGetsWhatIsKnownOnceAllButTheLastFewAreMatched) {
  StampCorrection corrections(3);
  EXPECT_EQ(GiveOut(corrections), Ms(0));
  corrections.SetNewest(Ms(5));  // by the first sweep
  EXPECT_EQ(GiveOut(corrections), Ms(0));
  EXPECT_EQ(GiveOut(corrections), Ms(0)) << "the first one might not be matched yet";
  EXPECT_EQ(GiveOut(corrections), Ms(5));
}

TEST(StampCorrection, IsUnknownWhileASweepThatCountsIsUnmatched) {
  const StampCorrection corrections(3);
  EXPECT_FALSE(corrections.IsUnknown(2));
  EXPECT_TRUE(corrections.IsUnknown(3));
}

TEST(StampCorrection, WithoutLagTheNewestHoldsAtOnce) {
  StampCorrection corrections(1);
  corrections.CountSweep();
  Learn(corrections, 0, Ms(2));
  EXPECT_EQ(corrections.ForNextSweeps(), Ms(2));
  corrections.CountSweep();
  Learn(corrections, 0, Ms(-4));
  EXPECT_EQ(corrections.ForNextSweeps(), Ms(-4));
}

// A fast matcher has learned more by then than a slow one.
TEST(StampCorrection, SweepsThatOneMessageSetsFreeHaveOneCorrection) {
  StampCorrection corrections(2);
  corrections.CountSweep();
  Learn(corrections, 0, Ms(2));
  EXPECT_EQ(corrections.ForNextSweeps(), Ms(0));
  corrections.CountSweep();
  EXPECT_EQ(corrections.ForNextSweeps(), Ms(0));
  corrections.Learn(1);
  EXPECT_EQ(corrections.ForNextSweeps(), Ms(2));
}

// The match of the fifth sweep begins an initialization, which matches all five once more: what
// they show comes after the fifth.
TEST(StampCorrection, WhatSweepsShowThatAreMatchedOnceMoreComesAfterAllOfThem) {
  StampCorrection corrections(2);
  for (int i = 0; i < 5; ++i) corrections.CountSweep();
  Learn(corrections, 1, Ms(0));  // after four
  Learn(corrections, 5, Ms(0));
  Learn(corrections, 3, Ms(2));  // after two of them
  EXPECT_EQ(corrections.ForNextSweeps(), Ms(0));
  corrections.CountSweep();
  corrections.Learn(0);
  EXPECT_EQ(corrections.ForNextSweeps(), Ms(2));
}

}  // namespace
}  // namespace lio
