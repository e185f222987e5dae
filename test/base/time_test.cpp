// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/time.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(Time, SecondsRoundToTheNearestNanosecond) {
  EXPECT_EQ(Duration::FromSeconds(0.1).ns, 100'000'000);
  EXPECT_EQ(Duration::FromSeconds(-0.1).ns, -100'000'000);
  EXPECT_EQ(Duration::FromSeconds(1e-9).ns, 1);
}

TEST(Time, DifferencesOfEpochStampsAreExact) {
  const Timestamp a{1'700'000'000'123'456'789};
  EXPECT_DOUBLE_EQ(SecondsBetween(a, a + Duration{1}), 1e-9);
}

TEST(Time, MicrosecondsTruncateTowardThePast) {
  EXPECT_EQ(Timestamp{1999}.Microseconds(), 1);
  EXPECT_EQ(Timestamp{-1}.Microseconds(), -1);
  EXPECT_EQ(Timestamp::FromMicroseconds(7).ns, 7000);
}

}  // namespace
}  // namespace lio
