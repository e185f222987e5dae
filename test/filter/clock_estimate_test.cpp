// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/clock_estimate.hpp"

#include <gtest/gtest.h>

#include "lio/filter/filter_parameters.hpp"

namespace lio {
namespace {

constexpr Timestamp kStart{1'700'000'000'000'000'000};

TEST(ClockEstimateTest, OffsetGoesOnAtItsRateAndWalks) {
  const ClockEstimate before{
      {0.003, 2e-5}, Eigen::Vector2d(1e-8, 1e-12).asDiagonal().toDenseMatrix(), kStart};
  const ClockEstimate after = Predicted(before, kStart + Duration::FromSeconds(100.0));
  EXPECT_NEAR(after.mean[0], 0.005, 1e-15);
  EXPECT_NEAR(after.mean[1], 2e-5, 1e-15);
  const double walk_std_s = kFilterParameters.clock_offset.walk_s_per_sqrt_s;
  EXPECT_NEAR(after.cov(0, 0), 1e-8 + 1e-12 * 1e4 + walk_std_s * walk_std_s * 100.0, 1e-18);
  EXPECT_NEAR(after.cov(0, 1), 1e-10, 1e-18);
  EXPECT_NEAR(after.cov(1, 1), 1e-12, 1e-20);
  EXPECT_EQ(after.as_of, kStart + Duration::FromSeconds(100.0));
}

TEST(ClockEstimateTest, NoTimePassesWhereClocksWereSet) {
  EXPECT_EQ(PassedTime_s(kStart, kStart - Duration::FromSeconds(5.0)), 0.0);
  EXPECT_EQ(PassedTime_s(kStart, kStart + Duration::FromSeconds(3600.0)), 0.0);
  EXPECT_EQ(PassedTime_s(kStart, kStart + Duration::FromSeconds(5.0)), 5.0);
}

}  // namespace
}  // namespace lio
