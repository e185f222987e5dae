// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/verdict/verdict.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

TEST(Verdict, NamesAreThoseOfTheEnumerators) {
  EXPECT_EQ(Name(Trust::kYes), "yes");
  EXPECT_EQ(Name(Trust::kNo), "no");
  EXPECT_EQ(Name(CauseKind::kClockOffset), "clock_offset");
  EXPECT_EQ(Name(CauseKind::kExtrinsicInverted), "extrinsic_inverted");
  EXPECT_EQ(Name(CauseKind::kOwnVehicle), "own_vehicle");
  EXPECT_EQ(Name(CauseKind::kNoImu), "no_imu");
}

}  // namespace
}  // namespace lio
