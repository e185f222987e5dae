// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sensor/imu_sample.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(ImuSample, OneThatWasSentWithinItsRangeIsMeasured) {
  EXPECT_TRUE(ImuSample{}.IsMeasured());
}

TEST(ImuSample, OneAtTheEndOfItsRangeOrMadeUpIsNot) {
  ImuSample rate, force, made_up;
  rate.is_rate_saturated = true;
  force.is_force_saturated = true;
  made_up.made_up_w_std_radps = 0.1f;
  for (const ImuSample& sample : {rate, force, made_up}) EXPECT_FALSE(sample.IsMeasured());
}

}  // namespace
}  // namespace lio
