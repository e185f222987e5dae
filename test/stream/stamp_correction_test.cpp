// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/stamp_correction.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

constexpr Duration Ms(int ms) {
  return {1'000'000 * std::int64_t{ms}};
}

TEST(StampCorrection, ASweepGetsWhatIsKnownOnceAllButTheLastFewAreMatched) {
  StampCorrection corrections(3);
  corrections.CountSweep();
  corrections.Learn(0, Ms(5));  // by the first sweep
  corrections.CountSweep();
  EXPECT_EQ(corrections.ForNextSweep(), Ms(0)) << "the first one might not be matched yet";
  corrections.CountSweep();
  EXPECT_EQ(corrections.ForNextSweep(), Ms(5));
}

TEST(StampCorrection, IsUnknownWhileASweepThatCountsIsUnmatched) {
  const StampCorrection corrections(3);
  EXPECT_FALSE(corrections.IsUnknown(2));
  EXPECT_TRUE(corrections.IsUnknown(3));
}

TEST(StampCorrection, WithoutLagTheNewestHoldsAtOnce) {
  StampCorrection corrections(1);
  corrections.Learn(0, Ms(2));
  EXPECT_EQ(corrections.ForNextSweep(), Ms(2));
  corrections.CountSweep();
  corrections.Learn(0, Ms(-4));
  EXPECT_EQ(corrections.ForNextSweep(), Ms(-4));
}

// An initialization matches sweeps once more: what it learns then comes after the last of them.
TEST(StampCorrection, SweepsThatAreMatchedOnceMoreDoNotTakeBackWhatWasMatched) {
  StampCorrection corrections(2);
  for (int i = 0; i < 5; ++i) corrections.CountSweep();
  corrections.Learn(0, Ms(1));  // after five
  corrections.Learn(4, Ms(2));  // four of them again
  EXPECT_EQ(corrections.ForNextSweep(), Ms(0));
  corrections.CountSweep();
  EXPECT_EQ(corrections.ForNextSweep(), Ms(2));
}

}  // namespace
}  // namespace lio
