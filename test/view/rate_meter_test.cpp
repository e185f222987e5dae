// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "view/rate_meter.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;

RateMeter AtTenHertz(int num) {
  RateMeter meter;
  for (int i = 0; i < num; ++i) meter.Add(kSecond_us + i * kSecond_us / 10);
  return meter;
}

TEST(RateMeter, ASteadyStreamHasItsRate) {
  const RateMeter meter = AtTenHertz(100);
  EXPECT_NEAR(meter.RateHz(kSecond_us + 99 * kSecond_us / 10), 10.0, 1e-9);
}

TEST(RateMeter, ItIsKnownFromTheSecondMessageOn) {
  EXPECT_EQ(AtTenHertz(0).RateHz(kSecond_us), 0.0);
  EXPECT_EQ(AtTenHertz(1).RateHz(kSecond_us), 0.0);
  EXPECT_NEAR(AtTenHertz(2).RateHz(kSecond_us + kSecond_us / 10), 10.0, 1e-9);
}

TEST(RateMeter, SilenceBringsItDownToNothing) {
  const RateMeter meter = AtTenHertz(100);
  const std::int64_t last = kSecond_us + 99 * kSecond_us / 10;
  EXPECT_LT(meter.RateHz(last + kSecond_us), 10.0);
  EXPECT_EQ(meter.RateHz(last + 4 * kSecond_us), 0.0);
}

TEST(RateMeter, AClockThatIsSetBackBeginsAnew) {
  RateMeter meter = AtTenHertz(100);
  meter.Add(kSecond_us);
  EXPECT_EQ(meter.RateHz(kSecond_us), 0.0);
  meter.Add(kSecond_us + kSecond_us / 5);
  EXPECT_NEAR(meter.RateHz(kSecond_us + kSecond_us / 5), 5.0, 1e-9);
}

TEST(RateMeter, MessagesOfOneInstantHaveNoRate) {
  RateMeter meter;
  for (int i = 0; i < 20'000; ++i) meter.Add(kSecond_us);
  EXPECT_EQ(meter.RateHz(kSecond_us), 0.0);
}

}  // namespace
}  // namespace lio
