// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/low_mean.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(LowMean, FirstScanDecides) {
  LowMean mean;
  EXPECT_TRUE(mean.is_unknown());
  EXPECT_FALSE(mean.is_low());
  mean.Add(0.19, 0.2, 0.3);
  EXPECT_FALSE(mean.is_unknown());
  EXPECT_TRUE(mean.is_low());
  LowMean enough;
  enough.Add(0.21, 0.2, 0.3);
  EXPECT_FALSE(enough.is_low());
}

TEST(LowMean, ItIsEnoughAgainOnlyAboveTheSecondLimit) {
  LowMean mean;
  mean.Add(0.1, 0.2, 0.3);
  for (int i = 0; i < 100; ++i) mean.Add(0.29, 0.2, 0.3);
  EXPECT_TRUE(mean.is_low());
  for (int i = 0; i < 100; ++i) mean.Add(0.35, 0.2, 0.3);
  EXPECT_FALSE(mean.is_low());
  for (int i = 0; i < 100; ++i) mean.Add(0.21, 0.2, 0.3);
  EXPECT_FALSE(mean.is_low());
}

TEST(LowMean, OneLowValueChangesNothing) {
  LowMean mean;
  mean.Add(0.5, 0.2, 0.3);
  mean.Add(0.0, 0.2, 0.3);
  EXPECT_FALSE(mean.is_low());
}

}  // namespace
}  // namespace lio
