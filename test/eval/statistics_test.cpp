// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

TEST(Statistics, SummaryOfKnownSamples) {
  const ErrorStats stats = Summarise({3, -4, 0, 1});
  EXPECT_EQ(stats.count, 4);
  EXPECT_DOUBLE_EQ(stats.rmse, std::sqrt(26.0 / 4));
  EXPECT_DOUBLE_EQ(stats.mean, 2);
  EXPECT_DOUBLE_EQ(stats.median, 2);
  EXPECT_DOUBLE_EQ(stats.max, 4);
}

TEST(Statistics, MedianOfOddEvenAndNone) {
  EXPECT_EQ(Median({5, 1, 3}), 3);
  EXPECT_EQ(Median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(Median({}), 0);
}

TEST(Statistics, NoSamplesGiveZeros) {
  const ErrorStats stats = Summarise({});
  EXPECT_EQ(stats.count, 0);
  EXPECT_EQ(stats.rmse, 0);
}

}  // namespace
}  // namespace lio
