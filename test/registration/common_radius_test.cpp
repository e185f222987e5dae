// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/common_radius.hpp"

#include <gtest/gtest.h>

#include "support/guess_cov.hpp"

namespace lio {
namespace {

using test::GuessCov;

TEST(CommonRadius, IsThatOfAPointAtTheLever) {
  constexpr double kLever_m = CorrespondenceParameters::kLever_m;
  const CommonRadius radius(GuessCov(0.1, 0.1 / kLever_m));
  EXPECT_NEAR(radius.std_m(), std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(radius.variance(), 0.02f, 1e-8f);
}

TEST(CommonRadius, HasABound) {
  EXPECT_EQ(CommonRadius(GuessCov(100.0, 1.0)).std_m(), CorrespondenceParameters::kMaxStd_m);
}

TEST(CommonRadius, ShrinksToNothing) {
  CommonRadius radius(GuessCov(0.5, 0.05));
  int num_steps = 0;
  while (!radius.IsExhausted()) {
    const double before_m = radius.std_m();
    radius.Shrink();
    EXPECT_LT(radius.std_m(), before_m);
    ASSERT_LT(++num_steps, 20);
  }
  EXPECT_EQ(radius.std_m(), 0.0);
}

TEST(CommonRadius, AnExactGuessNeedsNone) {
  EXPECT_TRUE(CommonRadius(Matrix6::Zero()).IsExhausted());
}

}  // namespace
}  // namespace lio
