// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Sixteen beams see a street as a few rings, which move with the sensor (docs/filter.md, "ring
// lock"): what is matched against them must neither hold the vehicle back nor tilt it.
#include <gtest/gtest.h>

#include "support/simulated_run.hpp"

namespace lio::sim {
namespace {

using test::RunOver;

// Was 24 cm and 0.2 deg when beams through crowns of trees made planes.
TEST(FewBeams, DrivingOffFromRestIsNotHeldBack) {
  const test::RunOutcome outcome = RunOver({"loop", "vlp16", 10.0}, true);
  EXPECT_EQ(outcome.status, TrackingStatus::kOk);
  EXPECT_LT(outcome.end_error_m, 0.08);
  EXPECT_LT(outcome.end_error_deg, 0.15);
}

// On a motorway scans cling to the rings of the standstill until they are refused. That is no
// reason to doubt the inertial unit's axes and to begin the start anew by those scans.
TEST(FewBeams, ScansThatClingToARestDoNotCostTheStart) {
  const test::RunOutcome outcome = RunOver({"motorway", "vlp16", 18.0, 12, {}, 5.0}, true);
  EXPECT_NE(outcome.status, TrackingStatus::kLost);
  EXPECT_LT(outcome.end_error_m, 1.0) << "of 256 m; was 2.1 m";
}

TEST(FewBeams, AWalkIsTrackedWithoutAnImu) {
  const test::RunOutcome outcome = RunOver({"campus", "vlp16", 15.0}, false);
  EXPECT_EQ(outcome.status, TrackingStatus::kOk);
  EXPECT_LT(outcome.end_error_m, 0.15);
}

}  // namespace
}  // namespace lio::sim
