// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/scan_timings.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(ScanTimings, AScanKeepsItsTimesUntilManyNewerOnesHaveCome) {
  ScanTimings timings;
  timings.Of(7).arrived_utime = 100;
  EXPECT_FALSE(timings.Of(7).is_complete());
  timings.Of(7).started_utime = 200;
  EXPECT_TRUE(timings.Of(7).is_complete());
  EXPECT_FALSE(timings.Of(8).is_complete()) << "another scan";
  const auto replacement = static_cast<std::int32_t>(7 + ScanTimings::kMaxScans);
  EXPECT_EQ(timings.Of(replacement).arrived_utime, 0);
  EXPECT_EQ(timings.Of(7).arrived_utime, 0) << "forgotten";
}

TEST(ScanTimings, ASequenceThatWrapsIsServed) {
  ScanTimings timings;
  timings.Of(-5).arrived_utime = 1;
  EXPECT_EQ(timings.Of(-5).arrived_utime, 1);
}

}  // namespace
}  // namespace lio
