// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/random.hpp"

#include <gtest/gtest.h>

namespace lio::sim {
namespace {

TEST(Random, SameKeyGivesTheSameNumbers) {
  Random a(3, Purpose::kWorld, 5);
  Random b(3, Purpose::kWorld, 5);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.Bits(), b.Bits());
}

TEST(Random, SeedPurposeAndStreamEachMakeAnotherSequence) {
  const std::uint64_t first = Random(3, Purpose::kWorld, 5).Bits();
  EXPECT_NE(first, Random(4, Purpose::kWorld, 5).Bits());
  EXPECT_NE(first, Random(3, Purpose::kImu, 5).Bits());
  EXPECT_NE(first, Random(3, Purpose::kWorld, 6).Bits());
}

TEST(Random, GaussianHasUnitMoments) {
  Random random(1, Purpose::kImu);
  constexpr int kNum = 100000;
  double sum = 0.0;
  double sum_sq = 0.0;
  int num_beyond_2 = 0;
  for (int i = 0; i < kNum; ++i) {
    const double x = random.Gaussian();
    sum += x;
    sum_sq += x * x;
    num_beyond_2 += std::abs(x) > 2.0 ? 1 : 0;
  }
  // Each tolerance is four standard errors.
  EXPECT_NEAR(sum / kNum, 0.0, 4.0 / std::sqrt(kNum));
  EXPECT_NEAR(sum_sq / kNum, 1.0, 4.0 * std::sqrt(2.0 / kNum));
  EXPECT_NEAR(static_cast<double>(num_beyond_2) / kNum, 0.0455, 0.003);
}

TEST(Random, IntegerReachesBothEndsAndNothingElse) {
  Random random(1, Purpose::kWorld);
  int seen = 0;
  for (int i = 0; i < 1000; ++i) {
    const int k = random.Integer(2, 4);
    ASSERT_GE(k, 2);
    ASSERT_LE(k, 4);
    seen |= 1 << k;
  }
  EXPECT_EQ(seen, 0b11100);
}

TEST(Random, UnitIntervalExcludesItsEnds) {
  EXPECT_GT(UnitInterval(0), 0.0);
  EXPECT_LT(UnitInterval(~0ull), 1.0);
}

}  // namespace
}  // namespace lio::sim
