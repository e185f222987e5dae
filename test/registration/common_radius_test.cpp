// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/common_radius.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

Matrix6 Cov(double translation_std_m, double rotation_std_rad) {
  Vector6 variance;
  variance << Vector3::Constant(translation_std_m * translation_std_m),
      Vector3::Constant(rotation_std_rad * rotation_std_rad);
  return variance.asDiagonal();
}

TEST(CommonRadius, IsThatOfAPointAtTheLever) {
  constexpr double kLever_m = CorrespondenceParameters::kLever_m;
  const CommonRadius radius(Cov(0.1, 0.1 / kLever_m));
  EXPECT_NEAR(radius.std_m(), std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(radius.variance(), 0.02f, 1e-8f);
}

TEST(CommonRadius, HasABound) {
  EXPECT_EQ(CommonRadius(Cov(100.0, 1.0)).std_m(), CorrespondenceParameters::kMaxStd_m);
}

TEST(CommonRadius, ShrinksToNothing) {
  CommonRadius radius(Cov(0.5, 0.05));
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
