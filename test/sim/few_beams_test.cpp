// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Sixteen beams see a street as a few rings on the ground, which move with the sensor
// (docs/filter.md, "ring lock"). Registration on them must neither hold the vehicle's estimate back
// nor tilt it.
#include <gtest/gtest.h>

#include "support/simulated_run.hpp"

namespace lio::sim {
namespace {

using test::RunOver;

// The error was 24 cm and 0.2 deg when beams through crowns of trees were taken for planes.
TEST(FewBeams, DrivingOffFromRestIsNotHeldBack) {
  const test::RunOutcome outcome = RunOver({"loop", "vlp16", 10.0}, true);
  EXPECT_EQ(outcome.status, TrackingStatus::kOk);
  EXPECT_LT(outcome.end_error_m, 0.08);
  EXPECT_LT(outcome.end_error_deg, 0.15);
}

// On a motorway the matches stay on the rings seen at standstill until their poses are rejected.
// This is no evidence against the IMU's axes, and no reason to repeat the initialization with those
// scans.
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
